// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/contact_model_file.hpp>

#include "reader_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "model.toml");
    fuzz::expect_value_or_sentence(path, [&] {
        const ContactModel model = io::read_contact_model(path);
        check(model);
        const std::string text = io::contact_model_text(model);
        const ContactModel again =
            io::read_contact_model(fuzz::input_file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), "again.toml"));
        for (const ContactParameter& parameter : contact_parameters()) {
            const double value = model.*parameter.value;
            fuzz::expect(!std::isinf(value), parameter.name + " is infinite");
            fuzz::expect(!parameter.is_set(model) || value == again.*parameter.value,
                         parameter.name + " is " + to_text(value) + ", but reads back as " + to_text(again.*parameter.value));
        }
    });
    return 0;
}
