// The contact of a diagnosis' settings, for the program that runs it.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/diagnose/settings.hpp>

namespace coagula::diagnose {

/// Contact model with the terms that the settings switch on; of Hertz contacts without their load at rest, which a force that no
/// solver has would balance. @param radius mean radius of the particles [m].
ContactModel contact_model_of(const Settings& settings, double radius);

}  // namespace coagula::diagnose
