// One face of the cube tiling, as SISL and OpenCASCADE meet it with lines. A row traces few rays: they take
// 10^5 times as long as the rest.

#include <sisl.h>

#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Line.hxx>
#include <IntCurveSurface_HInter.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "tests/bench/ray_sets.h"
#include "tests/bench/rows.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {
namespace {

constexpr std::size_t every = 2000;  // ray: some 80 a round

TensorNet face() {
  return std::get<TensorNet>(build_family(R"({"type": "sphere_tiling", "topology": "cube"})").patches[0]);
}

class SislFace {
 public:
  SislFace() {
    const TensorNet net = face();
    std::vector<double> knots_u, knots_v, coefficients;
    for (int k = 0; k <= 2 * net.m + 1; ++k) knots_u.push_back(k > net.m);
    for (int k = 0; k <= 2 * net.n + 1; ++k) knots_v.push_back(k > net.n);
    // u fastest.
    for (int j = 0; j <= net.n; ++j)
      for (int i = 0; i <= net.m; ++i)
        for (int c = 0; c < 4; ++c) coefficients.push_back(net.at(i, j)[c]);
    surface_ = newSurf(net.m + 1, net.n + 1, net.m + 1, net.n + 1, knots_u.data(), knots_v.data(),
                       coefficients.data(), 2, 3, 1);
  }
  ~SislFace() { freeSurf(surface_); }
  SislFace(const SislFace&) = delete;
  SislFace& operator=(const SislFace&) = delete;

  std::size_t trace(const std::vector<Ray>& rays, double* error) const {
    std::size_t hits = 0;
    for (const Ray& ray : rays) {
      double origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z},
             direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
      int points = 0, curves = 0, state = 0;
      double* parameters = nullptr;
      SISLIntcurve** list = nullptr;
      s1856(surface_, origin, direction, 3, 1e-14, 1e-9, &points, &parameters, &curves, &list, &state);
      hits += static_cast<std::size_t>(points);
      for (int k = 0; error && k < points; ++k) {
        double at[9], normal[3];
        int left = 0, right = 0;
        s1421(surface_, 0, parameters + 2 * k, &left, &right, at, normal, &state);
        *error = std::fmax(*error, std::fabs(std::hypot(at[0], at[1], at[2]) - 1.0));
      }
      std::free(parameters);
      freeIntcrvlist(list, curves);
    }
    return hits;
  }

 private:
  SISLSurf* surface_;
};

class OpenCascadeFace {
 public:
  OpenCascadeFace() {
    const TensorNet net = face();
    TColgp_Array2OfPnt poles(1, net.m + 1, 1, net.n + 1);
    TColStd_Array2OfReal weights(1, net.m + 1, 1, net.n + 1);
    for (int i = 0; i <= net.m; ++i)
      for (int j = 0; j <= net.n; ++j) {
        const dvec4& p = net.at(i, j);
        poles.SetValue(i + 1, j + 1, gp_Pnt(p.x / p.w, p.y / p.w, p.z / p.w));
        weights.SetValue(i + 1, j + 1, p.w);
      }
    surface_ = new GeomAdaptor_Surface(new Geom_BezierSurface(poles, weights));
  }

  std::size_t trace(const std::vector<Ray>& rays, double* error) const {
    std::size_t hits = 0;
    for (const Ray& ray : rays) {
      const Handle(GeomAdaptor_Curve) line =
          new GeomAdaptor_Curve(new Geom_Line(gp_Pnt(ray.origin.x, ray.origin.y, ray.origin.z),
                                              gp_Dir(ray.direction.x, ray.direction.y, ray.direction.z)),
                                0.0, 10.0);
      IntCurveSurface_HInter meeting;
      meeting.Perform(line, surface_);
      for (int k = 1; meeting.IsDone() && k <= meeting.NbPoints(); ++k) {
        ++hits;
        if (error) *error = std::fmax(*error, std::fabs(meeting.Point(k).Pnt().Distance(gp_Pnt()) - 1.0));
      }
    }
    return hits;
  }

 private:
  Handle(GeomAdaptor_Surface) surface_;
};

template <class Face>
Row row_of(const char* name) {
  const auto face_of = std::make_shared<const Face>();
  Row row{name, 1, [face_of](const std::vector<Ray>& rays) { return face_of->trace(rays, nullptr); }};
  row.part = every;
  std::vector<Ray> rays = incoherent_rays(100);
  face_of->trace(rays, &row.error);
  return row;
}

}  // namespace

std::vector<Row> cad_rows() {
  std::vector<Row> rows = {row_of<SislFace>("SISL s1856, one face"),
                           row_of<OpenCascadeFace>("OpenCASCADE, one face")};
  return rows;
}

}  // namespace rondure::bench
