#include "renderer/film/film_settings.h"

#include "renderer/film/layer_reader.h"

namespace rondure {
namespace {

constexpr std::int64_t largest_side = 65536;

Filter read_filter(const std::string& kind, double radius) {
  if (kind == "box") return Filter(FilterKind::box, radius);
  if (kind == "tent") return Filter(FilterKind::tent, radius);
  if (kind == "gaussian") return Filter(FilterKind::gaussian, radius);
  return Filter(FilterKind::blackman_harris, radius);
}

std::string read_kind(Params& params, std::string_view key) {
  return params.choice(key, {"box", "tent", "gaussian", "blackman_harris"}, "blackman_harris");
}

}  // namespace

FilmSettings read_film(Params& params) {
  FilmSettings film;
  if (params.has("resolution")) {
    const std::vector<std::int64_t> size = params.integers("resolution", 1, largest_side);
    if (size.size() != 2) params.fail("resolution", "must be two integers, width and height");
    film.width = static_cast<int>(size[0]);
    film.height = static_cast<int>(size[1]);
  }
  const Value* filter = params.raw("filter");
  if (filter != nullptr && filter->kind == Value::Kind::object) {
    Params inner = params.object("filter");
    const std::string kind = read_kind(inner, "type");
    film.filter = read_filter(kind, inner.number("radius", 0.0, Range::closed(0.0, 16.0)));
    inner.finish();
  } else {
    film.filter = read_filter(read_kind(params, "filter"), 0.0);
  }
  film.layers = read_layers(params);
  params.finish();
  return film;
}

const std::vector<TypeDoc>& film_docs() {
  static const std::vector<TypeDoc> docs = {
      {"film",
       "The picture's size, its pixel filter, and what its file holds beside the colour.",
       {{"resolution", "two integers in [1, 65536]", "[640, 480]", "width and height in pixels"},
        {"filter", "\"box\", \"tent\", \"gaussian\", \"blackman_harris\", or {\"type\", \"radius\"}",
         "\"blackman_harris\"",
         "pixel filter, by importance sampling; radius in pixels, 0 for the kind's own (0.5, 1, 1.5, 2)"},
        {"layers", "array of names, or objects {\"type\", ...}", "[]",
         "layers beside those that every film has, from the ray through each pixel's centre; see rondure "
         "list"}}},
  };
  return docs;
}

}  // namespace rondure
