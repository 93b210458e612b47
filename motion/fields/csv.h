// Tables as programs write them, for io::Scanner. Internal to motion/.
#pragma once

#include <string>

namespace kinemesh {

// Commas become blanks, and so do the quotes around a cell that is one word. Lines stay.
std::string without_commas(std::string csv);

}  // namespace kinemesh
