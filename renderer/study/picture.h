// Pictures that a study takes: the same geometry seen and shaded in many ways.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/legend.h"
#include "renderer/film/film.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_reader.h"
#include "renderer/study/folder.h"

namespace rondure {

// A scene as text, and the film that comes of it; its geometry is `tracer`, which must hold the same surfaces
// in the same order.
Film take_picture(const std::string& scene_text, const std::string& name, const Registry& registry,
                  const Tracer& tracer, const SceneOverrides& overrides = {});

// Of a scene that brings its own.
Tracer tracer_for(const std::string& scene_text, const std::string& name, const Registry& registry);

// 8-bit sRGB, top row first, as a PNG file's bytes, each pixel as a square of `zoom` screen pixels; `legend`
// below it.
std::string png_bytes(const StudyFolder& folder, const std::vector<unsigned char>& rgb, int width, int height,
                      int zoom = 1, const Legend* legend = nullptr);
// The film's colour.
std::string png_bytes(const StudyFolder& folder, const Film& film, int zoom = 1,
                      const Legend* legend = nullptr);

}  // namespace rondure
