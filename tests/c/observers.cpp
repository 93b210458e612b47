#include "observers.h"

#include <stdexcept>

int throws(const kinemesh_changes* changes, void* what) {
  switch (*static_cast<int32_t*>(what)) {
    case THROW_EXCEPTION:
      throw std::runtime_error("the solver is out of breath");
    case THROW_NUMBER:
      throw changes->step;
    default:
      return 0;
  }
}
