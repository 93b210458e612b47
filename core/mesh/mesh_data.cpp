#include "kinemesh/mesh_data.h"

#include "kinemesh/error.h"

namespace kinemesh {

void check_size(std::size_t n, const std::string& what) {
  if (n > static_cast<std::size_t>(most_items))
    throw InputError(std::to_string(n) + " " + what + ", at most " + std::to_string(most_items) +
                     " expected");
}

}  // namespace kinemesh
