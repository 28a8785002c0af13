#include "renderer/projective/bspline.h"

#include <fmt/format.h>

#include <cmath>

namespace rondure {
namespace {

// Arguments of Bernstein coefficient k of degree n over [a, b].
std::vector<long double> corner_arguments(int n, int k, long double a, long double b) {
  std::vector<long double> arguments(static_cast<std::size_t>(n), a);
  for (int r = 0; r < k; ++r) arguments[static_cast<std::size_t>(r)] = b;
  return arguments;
}

// The blossom of a polynomial in Bernstein form over [a, b].
lvec4 blossom(std::vector<lvec4> c, long double a, long double b, const std::vector<long double>& arguments) {
  for (const long double t : arguments) {
    const long double s = (t - a) / (b - a);
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] = (1 - s) * c[k] + s * c[k + 1];
    c.pop_back();
  }
  return c[0];
}

}  // namespace

std::string knot_defect(int degree, const std::vector<long double>& knots, std::size_t points) {
  const std::size_t expected = points + static_cast<std::size_t>(degree) + 1;
  if (knots.size() != expected)
    return fmt::format("{} control points of degree {} need {} knots, not {}", points, degree, expected,
                       knots.size());
  std::size_t equal = 1;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    if (!(knots[k] >= knots[k - 1])) return fmt::format("knot {} is less than the one before it", k);
    equal = knots[k] == knots[k - 1] ? equal + 1 : 1;
    if (equal > static_cast<std::size_t>(degree) + 1)
      return fmt::format("knot {} is repeated more than {} times", k, degree + 1);
    if (equal > static_cast<std::size_t>(degree) && k < points && k > static_cast<std::size_t>(degree))
      return fmt::format("knot {} is repeated more than {}, which would tear it apart", k,
                         degree == 1 ? "once" : fmt::format("{} times", degree));
  }
  if (points <= static_cast<std::size_t>(degree))
    return fmt::format("degree {} needs {} control points at least", degree, degree + 1);
  if (!(knots[static_cast<std::size_t>(degree)] < knots[points])) return "the knots leave no interval";
  return "";
}

std::vector<std::size_t> spans_of(int degree, const std::vector<long double>& knots, std::size_t points) {
  std::vector<std::size_t> spans;
  for (std::size_t k = static_cast<std::size_t>(degree); k < points; ++k) {
    if (knots[k] < knots[k + 1]) spans.push_back(k);
  }
  return spans;
}

lvec4 blossom(const BSpline& spline, std::size_t span, const std::vector<long double>& arguments) {
  const auto d = static_cast<std::size_t>(spline.degree);
  std::vector<lvec4> c;
  for (std::size_t j = 0; j <= d; ++j) c.push_back(spline.points[span - d + j]);
  for (std::size_t r = 1; r <= d; ++r) {
    for (std::size_t j = d; j >= r; --j) {
      const long double low = spline.knots[span - d + j], high = spline.knots[span + 1 + j - r];
      const long double s = (arguments[r - 1] - low) / (high - low);
      c[j] = (1 - s) * c[j - 1] + s * c[j];
    }
  }
  return c[d];
}

std::vector<lvec4> bezier_piece(const BSpline& spline, std::size_t span) {
  const long double a = spline.knots[span], b = spline.knots[span + 1];
  std::vector<lvec4> piece;
  for (int k = 0; k <= spline.degree; ++k)
    piece.push_back(blossom(spline, span, corner_arguments(spline.degree, k, a, b)));
  return piece;
}

BSpline sphere_image(const BSpline& preimage) {
  const int d = preimage.degree;
  BSpline image;
  image.degree = 2 * d;
  for (std::size_t k = 0; k < preimage.knots.size(); ++k) {
    const bool fresh = k == 0 || preimage.knots[k] > preimage.knots[k - 1];
    image.knots.insert(image.knots.end(), fresh ? static_cast<std::size_t>(d) + 1 : 1, preimage.knots[k]);
  }
  // Point i is the blossom, of any span on which basis function i lives, at the knots inside its support.
  const auto twice = static_cast<std::size_t>(image.degree);
  const std::size_t count = image.knots.size() - twice - 1;
  const std::vector<std::size_t> spans = spans_of(d, preimage.knots, preimage.points.size());
  for (std::size_t i = 0; i < count; ++i) {
    const long double start = image.knots[i], end = image.knots[i + twice + 1];
    const std::vector<long double> inside(image.knots.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                          image.knots.begin() + static_cast<std::ptrdiff_t>(i + twice) + 1);
    for (const std::size_t span : spans) {
      const long double a = preimage.knots[span], b = preimage.knots[span + 1];
      if (a < start || b > end) continue;
      const TensorPolynomial<lvec4> piece(d, 0, bezier_piece(preimage, span));
      const auto product = multiply(piece, piece, [](const lvec4& p, const lvec4& q) { return delta(p, q); });
      image.points.push_back(blossom(product.coefficients, a, b, inside));
      break;
    }
  }
  return image;
}

std::vector<TensorPreimage> bezier_pieces(const BSplineSurface& surface) {
  const std::size_t rows = surface.points.size() / surface.columns;
  std::vector<TensorPreimage> pieces;
  for (const std::size_t in_u : spans_of(surface.degree_u, surface.knots_u, rows)) {
    // Columns of coefficients along u, which are points of B-splines along v.
    std::vector<BSpline> along_v(static_cast<std::size_t>(surface.degree_u) + 1,
                                 {surface.degree_v, surface.knots_v, {}});
    for (std::size_t j = 0; j < surface.columns; ++j) {
      BSpline column{surface.degree_u, surface.knots_u, {}};
      for (std::size_t i = 0; i < rows; ++i) column.points.push_back(surface.points[i * surface.columns + j]);
      const std::vector<lvec4> piece = bezier_piece(column, in_u);
      for (std::size_t k = 0; k < piece.size(); ++k) along_v[k].points.push_back(piece[k]);
    }
    for (const std::size_t in_v : spans_of(surface.degree_v, surface.knots_v, surface.columns)) {
      TensorPreimage patch(surface.degree_u, surface.degree_v, {});
      for (const BSpline& row : along_v) {
        const std::vector<lvec4> piece = bezier_piece(row, in_v);
        patch.coefficients.insert(patch.coefficients.end(), piece.begin(), piece.end());
      }
      pieces.push_back(std::move(patch));
    }
  }
  return pieces;
}

}  // namespace rondure
