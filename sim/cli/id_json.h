// Numbers of vertices and faces in JSON.
#pragma once

#include "kinemesh/types.h"

namespace kinemesh {

// Found by nlohmann's library, for lists of them, too.
template <class Json, class Of>
void to_json(Json& json, Id<Of> id) {
  json = int{id};
}

}  // namespace kinemesh
