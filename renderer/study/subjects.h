// The surfaces that the studies look at: every family that ships, every way to patch a sphere, and what
// degenerates otherwise.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/registry.h"
#include "renderer/scene/scene.h"

namespace rondure {

struct Subject {
  std::string name;
  std::string object;   // JSON: an entry of a scene's "objects"
  bool sphere = false;  // the whole unit sphere about the origin
  double size = 1.0;    // of close-ups' radii
};

const std::vector<Subject>& subjects();

// Those named, in the order of the table; all where none is named. Throws std::runtime_error for an unknown
// name.
std::vector<Subject> subjects_named(const std::vector<std::string>& names);

// Of those, in the order of the table, the whole unit spheres. Throws for a name of something else.
std::vector<Subject> spheres_named(const std::vector<std::string>& names);

// Those of a scene's objects that have patches, each by its nets in its own frame, called by its place and
// type. Throws std::runtime_error where there are none.
std::vector<Subject> subjects_of_scene(const std::string& path, const Registry& registry);

// The same in general position. About the axes the tangents of many singular points are exactly along one of
// them, and their cross product is right in any precision.
Subject turned(Subject subject);

// The subject alone, as its object says, with the solver that a scene takes for it by default.
TracedSurface traced_subject(const Subject& subject, const Registry& registry);
Surface surface_of(const Subject& subject, const Registry& registry);

}  // namespace rondure
