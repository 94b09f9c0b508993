// SPDX-License-Identifier: GPL-3.0-or-later
// Workbooks of Office Open XML (ECMA-376): a ZIP archive of XML files. Only what cells hold is read: no styles, so that dates stay
// the numbers that they are.
#include "workbook_text.hpp"

#include <coagula/common/checks.hpp>

#include <expat.h>
#include <unzip.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace coagula::io {

namespace {

constexpr std::size_t most_bytes = 100'000'000;  ///< of a file in the archive, inflated, and of the text that is made
constexpr std::size_t most_columns = 16384;      ///< of a sheet, by the format

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw InputError(path + " is an Excel workbook (.xlsx) that cannot be read: " + what + "; save each sheet as CSV");
}

/// An open archive.
class Archive {
public:
    explicit Archive(const std::string& path) : path_(path), handle_(unzOpen64(path.c_str()), unzClose) {
        if (!handle_) {
            refuse(path, "the archive is damaged");
        }
    }

    bool has(const std::string& name) const { return unzLocateFile(handle_.get(), name.c_str(), 1) == UNZ_OK; }

    std::string read(const std::string& name) const {
        if (!has(name) || unzOpenCurrentFile(handle_.get()) != UNZ_OK) {
            refuse(path_, "it lacks " + name);
        }
        std::string bytes;
        std::array<char, 1 << 16> buffer{};
        int count = 0;
        while ((count = unzReadCurrentFile(handle_.get(), buffer.data(), buffer.size())) > 0) {
            bytes.append(buffer.data(), static_cast<std::size_t>(count));
            if (bytes.size() > most_bytes) {
                refuse(path_, name + " has more than 100 MB");
            }
        }
        if (count < 0 || unzCloseCurrentFile(handle_.get()) != UNZ_OK) {
            refuse(path_, name + " is damaged");
        }
        return bytes;
    }

private:
    const std::string& path_;
    std::unique_ptr<void, int (*)(unzFile)> handle_;
};

using Attributes = std::map<std::string, std::string>;

/// What to do with the parts of an XML file; names come without their prefix.
struct XmlHandler {
    std::function<void(const std::string&, const Attributes&)> begin;
    std::function<void(const std::string&)> end = [](const std::string&) {};
    std::function<void(std::string_view)> text = [](std::string_view) {};
    XML_Parser parser = nullptr;
};

std::string local_name(std::string_view name) {
    const std::size_t colon = name.rfind(':');
    return std::string(colon == std::string_view::npos ? name : name.substr(colon + 1));
}

void begin_element(void* data, const XML_Char* name, const XML_Char** attributes) {
    Attributes named;
    for (; *attributes != nullptr; attributes += 2) {             // NOLINT: expat gives pairs of pointers
        named.emplace(local_name(attributes[0]), attributes[1]);  // NOLINT
    }
    static_cast<XmlHandler*>(data)->begin(local_name(name), named);
}

void end_element(void* data, const XML_Char* name) {
    static_cast<XmlHandler*>(data)->end(local_name(name));
}

void take_text(void* data, const XML_Char* text, int length) {
    static_cast<XmlHandler*>(data)->text({text, static_cast<std::size_t>(length)});
}

/// No workbook has a document type, whose entities can be made to grow without bounds.
void stop_at_document_type(void* data, const XML_Char* /*name*/, const XML_Char* /*system*/, const XML_Char* /*public_name*/,
                           int /*internal*/) {
    XML_StopParser(static_cast<XmlHandler*>(data)->parser, XML_FALSE);
}

void parse_xml(const std::string& path, const std::string& bytes, XmlHandler handler) {
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr), XML_ParserFree);
    handler.parser = parser.get();
    XML_SetUserData(parser.get(), &handler);
    XML_SetElementHandler(parser.get(), begin_element, end_element);
    XML_SetCharacterDataHandler(parser.get(), take_text);
    XML_SetStartDoctypeDeclHandler(parser.get(), stop_at_document_type);
    if (XML_Parse(parser.get(), bytes.data(), static_cast<int>(bytes.size()), XML_TRUE) != XML_STATUS_OK) {
        refuse(path, "its XML is damaged");
    }
}

std::string attribute(const Attributes& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? "" : found->second;
}

struct Sheet {
    std::string name;
    std::string file;
};

/// The sheets in their order.
std::vector<Sheet> sheets_of(const std::string& path, const Archive& archive) {
    std::map<std::string, std::string> files;  // by their id
    parse_xml(path, archive.read("xl/_rels/workbook.xml.rels"),
              {.begin = [&](const std::string& name, const Attributes& attributes) {
                  const std::string target = attribute(attributes, "Target");
                  if (name == "Relationship" && target.find("worksheets/") != std::string::npos) {
                      files[attribute(attributes, "Id")] = target.starts_with('/') ? target.substr(1) : "xl/" + target;
                  }
              }});
    std::vector<Sheet> sheets;
    parse_xml(path, archive.read("xl/workbook.xml"), {.begin = [&](const std::string& name, const Attributes& attributes) {
                  if (const auto file = files.find(attribute(attributes, "id")); name == "sheet" && file != files.end()) {
                      sheets.push_back({plain_cell(attribute(attributes, "name")), file->second});
                  }
              }});
    return sheets;
}

/// Text within <t>, but for that of phonetic runs, which say how to read it.
class RichText {
public:
    void begin(const std::string& name) {
        phonetic_ = phonetic_ || name == "rPh";
        inside_ = inside_ || name == "t";
    }
    void end(const std::string& name) {
        phonetic_ = phonetic_ && name != "rPh";
        inside_ = inside_ && name != "t";
    }
    void add(std::string_view text) {
        if (inside_ && !phonetic_) {
            text_ += text;
        }
    }
    std::string take() { return std::exchange(text_, {}); }

private:
    bool phonetic_ = false;
    bool inside_ = false;
    std::string text_;
};

std::vector<std::string> shared_strings(const std::string& path, const Archive& archive) {
    std::vector<std::string> strings;
    if (!archive.has("xl/sharedStrings.xml")) {
        return strings;
    }
    RichText text;
    parse_xml(path, archive.read("xl/sharedStrings.xml"),
              {.begin = [&](const std::string& name, const Attributes&) { text.begin(name); },
               .end =
                   [&](const std::string& name) {
                       text.end(name);
                       if (name == "si") {
                           strings.push_back(plain_cell(text.take()));
                       }
                   },
               .text = [&](std::string_view part) { text.add(part); }});
    return strings;
}

/// The column of "AB12", from 0; beyond every sheet where there is none.
std::size_t column_of(const std::string& reference) {
    std::size_t column = 0;
    for (std::size_t i = 0; i < reference.size() && reference[i] >= 'A' && reference[i] <= 'Z' && column <= most_columns; ++i) {
        column = 26 * column + static_cast<std::size_t>(reference[i] - 'A') + 1;
    }
    return column - 1;
}

std::size_t whole_number(const std::string& text, std::size_t otherwise) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? number : otherwise;
}

/// The rows of a sheet as lines.
class SheetText {
public:
    SheetText(const std::string& path, const std::vector<std::string>& strings) : path_(path), strings_(strings) {}

    std::string run(const std::string& xml) {
        parse_xml(path_, xml,
                  {.begin = [&](const std::string& name, const Attributes& attributes) { begin(name, attributes); },
                   .end = [&](const std::string& name) { end(name); },
                   .text =
                       [&](std::string_view part) {
                           inline_.add(part);
                           value_.append(in_value_ ? part : std::string_view{});
                       }});
        return std::move(text_);
    }

private:
    void begin(const std::string& name, const Attributes& attributes) {
        inline_.begin(name);
        in_value_ = in_value_ || name == "v";
        if (name == "row") {
            const std::size_t row = whole_number(attribute(attributes, "r"), row_ + 1);
            text_ += row > row_ + 1 ? "\n" : "";
            row_ = row;
            cells_.clear();
        } else if (name == "c") {
            const std::string reference = attribute(attributes, "r");
            column_ = reference.empty() ? cells_.size() : column_of(reference);
            type_ = attribute(attributes, "t");
            value_.clear();
            inline_.take();
        }
    }

    void end(const std::string& name) {
        inline_.end(name);
        in_value_ = in_value_ && name != "v";
        if (name == "c") {
            add_cell();
        } else if (name == "row") {
            for (std::size_t i = 0; i < cells_.size(); ++i) {
                text_ += (i > 0 ? "\t" : "") + cells_[i];
            }
            text_ += '\n';
            if (text_.size() > most_bytes) {
                refuse(path_, "its cells have more than 100 MB");
            }
        }
    }

    void add_cell() {
        if (column_ >= most_columns) {
            refuse(path_, "a cell lies in no column");
        }
        std::string text = plain_cell(type_ == "inlineStr" ? inline_.take() : value_);
        if (type_ == "s") {
            const std::size_t place = whole_number(text, strings_.size());
            if (place >= strings_.size()) {
                refuse(path_, "a cell refers to a text that is not there");
            }
            text = strings_[place];
        }
        if (!text.empty()) {
            cells_.resize(std::max(cells_.size(), column_ + 1));
            cells_[column_] = std::move(text);
        }
    }

    const std::string& path_;
    const std::vector<std::string>& strings_;
    std::string text_;
    std::size_t row_ = 0;
    std::size_t column_ = 0;
    std::string type_;
    std::string value_;
    bool in_value_ = false;
    RichText inline_;
    std::vector<std::string> cells_;
};

}  // namespace

std::string text_of_xlsx(const std::string& path) {
    const Archive archive(path);
    if (!archive.has("xl/workbook.xml")) {
        throw InputError(path + " is a ZIP archive without an Excel workbook: export the measurement as text or CSV");
    }
    const std::vector<std::string> strings = shared_strings(path, archive);
    std::string text;
    for (const Sheet& sheet : sheets_of(path, archive)) {
        text += sheet_mark + sheet.name + '\n' + SheetText(path, strings).run(archive.read(sheet.file));
        if (text.size() > most_bytes) {
            refuse(path, "its cells have more than 100 MB");
        }
    }
    return text;
}

}  // namespace coagula::io
