#include "surfaces/edge_data_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "renderer/bezier/index.h"
#include "renderer/complex/regular_joins.h"

namespace rondure {
namespace {

using Kind = Value::Kind;

class EdgeDataReader {
 public:
  explicit EdgeDataReader(Params& object) : object_(object) {}

  SurfaceComplex read() {
    const std::vector<std::int64_t> sides = object_.integers("sides", 3, 4);
    if (sides.empty() || sides.size() > 1000) object_.fail("sides", "there must be 1 to 1000 polygons");
    for (const std::int64_t s : sides) sides_.push_back(static_cast<int>(s));
    std::vector<Gluing> gluings;
    std::vector<std::optional<EdgeJoin>> given;
    for (Params& join : object_.objects("joins")) {
      gluings.push_back(read_gluing(join));
      given.push_back(read_data(join, gluings.back()));
      join.finish();
    }
    for (std::size_t i = 0; i < gluings.size(); ++i) refuse_double(gluings, i);
    SurfaceComplex complex = regular_complex(sides_, gluings);
    bool all_given = true;
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (given[k]) complex.joins[k] = *given[k];
      all_given = all_given && given[k];
    }
    complex.exact = (complex.exact || all_given) && exact_;
    return complex;
  }

 private:
  Params& object_;
  std::vector<int> sides_;
  bool exact_ = true;

  void refuse_double(const std::vector<Gluing>& gluings, std::size_t i) const {
    const auto refuse = [&](const EdgeRef& e, const char* how) {
      object_.fail("joins", fmt::format("(2) {} is glued {}", name_of(e), how));
    };
    if (gluings[i].p == gluings[i].q) refuse(gluings[i].p, "to itself");
    for (std::size_t j = 0; j < i; ++j) {
      for (const EdgeRef& e : {gluings[i].p, gluings[i].q}) {
        if (e == gluings[j].p || e == gluings[j].q) refuse(e, "more than once");
      }
    }
  }

  EdgeRef read_edge(Params& join, const Value& value) const {
    const auto whole = [](const Value& v) { return v.kind == Kind::number && v.integral && v.number >= 0; };
    const bool good = value.kind == Kind::array && value.items.size() == 2 && whole(value.items[0]) &&
                      whole(value.items[1]) && value.items[0].number < static_cast<double>(sides_.size());
    const int polygon = good ? static_cast<int>(value.items[0].number) : 0;
    if (!good || value.items[1].number >= sides_[index(polygon)])
      join.fail(value, "an edge is [polygon, edge], both counted from 0");
    return {polygon, static_cast<int>(value.items[1].number)};
  }

  Gluing read_gluing(Params& join) const {
    const Value* edges = join.raw("edges");
    if (!edges || edges->kind != Kind::array || edges->items.size() != 2)
      join.fail("a join has \"edges\": [[polygon, edge], [polygon, edge]]");
    return {read_edge(join, edges->items[0]), read_edge(join, edges->items[1]),
            join.boolean("reversed", true)};
  }

  Exact read_number(Params& join, const Value& value) {
    if (value.kind == Kind::number && std::isfinite(value.number)) {
      const double scaled = std::ldexp(value.number, 20);
      if (scaled != std::round(scaled)) exact_ = false;
      return exact_of(value.number);
    }
    if (value.kind == Kind::string) {
      const std::string& text = value.string;
      const std::size_t slash = text.find('/'), begin = text.rfind('-', 0) == 0 ? 1 : 0;
      const auto digits = [&](std::size_t from, std::size_t to) {
        return from < to && to - from <= 15 &&
               text.find_first_not_of("0123456789", from) >= std::min(to, text.size());
      };
      const std::size_t end = slash == std::string::npos ? text.size() : slash;
      const bool good =
          digits(begin, end) && (slash == std::string::npos ||
                                 (digits(slash + 1, text.size()) && std::stoll(text.substr(slash + 1)) != 0));
      if (good) {
        const Exact top = std::stoll(text.substr(0, end));
        return slash == std::string::npos ? top : Exact(top / std::stoll(text.substr(slash + 1)));
      }
    }
    join.fail(value, "expected a number or a fraction \"p/q\" of integers with 15 digits at most");
  }

  EdgePolynomial read_polynomial(Params& join, const Value& value) {
    if (value.kind != Kind::array) return EdgePolynomial(read_number(join, value));
    if (value.items.empty() || value.items.size() > 9)
      join.fail(value, "a polynomial is 1 to 9 Bernstein coefficients over the edge");
    std::vector<Exact> c;
    for (const Value& item : value.items) c.push_back(read_number(join, item));
    return from_bernstein(c);
  }

  EdgeFunction read_function(Params& join, const Value& value) {
    if (value.kind != Kind::object) return EdgeFunction(read_polynomial(join, value));
    const Value *n = value.find("numerator"), *d = value.find("denominator");
    if (!n || !d || value.members.size() != 2)
      join.fail(value, "a function is a number, Bernstein coefficients or {\"numerator\", \"denominator\"}");
    const EdgeFunction f(read_polynomial(join, *n), read_polynomial(join, *d));
    if (f.denominator.zero()) join.fail(*d, "the denominator must not be zero");
    return f;
  }

  EdgeField read_field(Params& join, const Value& value) {
    const Value* along = value.kind == Kind::object ? value.find("along") : nullptr;
    const Value* inward = value.kind == Kind::object ? value.find("inward") : nullptr;
    if (!along || !inward || value.members.size() != 2)
      join.fail(value, "a vector field is {\"along\", \"inward\"}, two functions of the edge's parameter");
    return {read_function(join, *along), read_function(join, *inward)};
  }

  std::optional<EdgeJoin> read_data(Params& join, Gluing& gluing) {
    const Value *fields = join.raw("fields"), *theta = join.raw("theta");
    const Value* parameter = join.raw("parameter");
    if (fields && theta) join.fail("theta", "give either \"fields\" or \"theta\", not both");
    if (parameter && join.has("reversed")) join.fail("parameter", "\"parameter\" tells what is reversed");
    if (parameter && !fields && !theta)
      join.fail("parameter", "a join with \"parameter\" needs \"fields\" or \"theta\"");
    EdgeFunction mu = edge_parameter(gluing.reversed);
    if (parameter) {
      mu = read_function(join, *parameter);
      if (mu.denominator.at(Exact(0)) == 0) join.fail(*parameter, "the parameter has a pole at s = 0");
      gluing.reversed = mu.at(Exact(0)) != 0;
    }
    if (theta) return join_by_image(gluing.p, gluing.q, mu, read_field(join, *theta));
    if (!fields) return std::nullopt;
    if (fields->kind != Kind::array || fields->items.size() != 2)
      join.fail(*fields, "\"fields\" are two vector fields, one on each edge");
    const EdgeField xi = read_field(join, fields->items[0]), eta = read_field(join, fields->items[1]);
    if (xi.inward.zero()) join.fail(fields->items[0], "a field must not run along its edge");
    return join_by_fields(gluing.p, gluing.q, mu, xi, eta);
  }
};

}  // namespace

SurfaceComplex read_joined_polygons(Params& object) { return EdgeDataReader(object).read(); }

}  // namespace rondure
