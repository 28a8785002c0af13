// The face of Cobb's cube tiling as tabulated (Cobb 1988, Table 4), rounded once.
#pragma once

#include "tests/reference_data.h"

namespace rondure {

inline TensorNet cube_face() {
  const nlohmann::json table = reference_entry(reference_data("cobb_nets.json"), "cube_face")["net"];
  TensorNet face(4, 4);
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      for (int c = 0; c < 4; ++c) face.at(i, j)[c] = number(table[i][j][c]);
    }
  }
  return face;
}

}  // namespace rondure
