// rondure eval --direction: surfaces as functions of the direction from their centre.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace rondure {

// Reads surface,dx,dy,dz from `table` and writes to `output` where the ray from the surface's centre (the
// place of its family's origin) meets it: surface,dx,dy,dz,hit,radius,x,y,z,nx,ny,nz,patch,u,v, the fields
// after `hit` empty where it is 0. Throws where a surface is not single-valued: a patch that turns back as
// seen from there (bezier/star_shaped.h), or a direction in which it is met twice.
void eval_directions(const Scene& scene, const std::string& table, const std::string& output);

}  // namespace rondure
