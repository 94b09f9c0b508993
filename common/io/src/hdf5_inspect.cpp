// SPDX-License-Identifier: GPL-3.0-or-later
// What hdf5::File refuses before anything is read.
#include <algorithm>
#include <set>
#include <utility>

#include <coagula/io/printable.hpp>
#include "hdf5_file.hpp"

namespace coagula::io::hdf5 {

namespace {

constexpr std::size_t deepest_group = 64;  // HDF5 walks groups by recursion

struct Link {
    std::string name;
    H5L_type_t type;
};

struct Group {
    std::string path;
    std::size_t depth;
};

herr_t append_link(hid_t /*group*/, const char* name, const H5L_info_t* info, void* links) {
    static_cast<std::vector<Link>*>(links)->push_back({name, info->type});
    return 0;
}

bool is_printable(const std::string& name) {
    return is_utf8(name) && std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 32; });
}

/// Walks all groups once, without recursion.
class Walk {
public:
    explicit Walk(const File& file) : file_(file) {}

    void run(hid_t id) {
        groups_.push_back({"/", 0});
        while (!groups_.empty()) {
            const Group group = std::move(groups_.back());
            groups_.pop_back();
            visit(Handle(H5Gopen2(id, group.path.c_str(), H5P_DEFAULT), H5Gclose), group);
        }
    }

private:
    void visit(const Handle& opened, const Group& group) {
        std::vector<Link> links;
        if (!opened || H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append_link, &links) < 0) {
            file_.fail(group.path, "cannot be listed: the file is damaged");
        }
        for (const Link& link : links) {
            if (!is_printable(link.name)) {
                file_.fail(group.path, "holds an object whose name is not a text in UTF-8: the file is damaged");
            }
            const std::string path = group.path + (group.depth == 0 ? "" : "/") + link.name;
            if (link.type == H5L_TYPE_HARD) {
                visit_object(Handle(H5Oopen(opened.get(), link.name.c_str(), H5P_DEFAULT), H5Oclose), path, group.depth + 1);
            } else if (link.type != H5L_TYPE_SOFT) {
                file_.fail(path, "is a link to another file, which coagula does not follow");
            }
        }
    }

    void visit_object(const Handle& object, const std::string& path, std::size_t depth) {
        H5O_info_t info{};
        if (!object || H5Oget_info2(object.get(), &info, H5O_INFO_BASIC) < 0) {
            file_.fail(path, "cannot be opened: the file is damaged");
        }
        if (!seen_.emplace(info.fileno, info.addr).second) {
            return;
        }
        if (info.type == H5O_TYPE_DATASET) {
            require_own_storage(object, path);
        } else if (info.type == H5O_TYPE_GROUP) {
            if (depth > deepest_group) {
                file_.fail(path, "lies in more than " + std::to_string(deepest_group) + " nested groups");
            }
            groups_.push_back({path, depth});
        }
    }

    void require_own_storage(const Handle& dataset, const std::string& path) const {
        const Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose);
        if (H5Pget_layout(properties.get()) == H5D_VIRTUAL) {
            file_.fail(path, "is a virtual dataset, which coagula does not read");
        }
        if (H5Pget_external_count(properties.get()) > 0) {
            file_.fail(path, "is stored in another file, which coagula does not read");
        }
    }

    const File& file_;
    std::vector<Group> groups_;
    std::set<std::pair<unsigned long, haddr_t>> seen_;
};

}  // namespace

void File::inspect() const {
    Walk(*this).run(id_.get());
}

}  // namespace coagula::io::hdf5
