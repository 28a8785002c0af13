// One ray a lane, for newton_arithmetic-inl.h. Included inside the namespace of an instruction set, with `hn`
// for Highway's; hence no guard and no include.

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr std::size_t lane_count = hn::MaxLanes(D());

struct Lanes {
  using Number = V;
  struct Point {
    V x, y, z, w;
    friend HWY_ATTR HWY_INLINE Point operator+(const Point& a, const Point& b) {
      return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
    }
    friend HWY_ATTR HWY_INLINE Point operator-(const Point& a, const Point& b) {
      return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
    }
    friend HWY_ATTR HWY_INLINE Point operator*(V s, const Point& p) {
      return {s * p.x, s * p.y, s * p.z, s * p.w};
    }
  };
  static HWY_ATTR HWY_INLINE V lift(double x) { return hn::Set(D(), x); }
  static HWY_ATTR HWY_INLINE V divided(V a, V b) { return a / b; }
  static HWY_ATTR HWY_INLINE V abs(V x) { return hn::Abs(x); }
  static HWY_ATTR HWY_INLINE V sqrt(V x) { return hn::Sqrt(x); }
  static HWY_ATTR HWY_INLINE V max(V a, V b) { return hn::Max(a, b); }
  static HWY_ATTR HWY_INLINE V where_positive(V x, V a, V b) {
    return hn::IfThenElse(hn::Gt(x, hn::Zero(D())), a, b);
  }
  static HWY_ATTR HWY_INLINE Point zero() {
    const V z = hn::Zero(D());
    return {z, z, z, z};
  }
  static HWY_ATTR HWY_INLINE Point load(const dvec4& p) {
    return {lift(p.x), lift(p.y), lift(p.z), lift(p.w)};
  }
};

struct LanePlanes {
  V plane[2][4];
  HWY_ATTR HWY_INLINE Pair<Lanes> operator()(const Lanes::Point& s) const {
    const auto dot = [&](const V* p)
                         HWY_ATTR { return (p[0] * s.x + p[1] * s.y) + (p[2] * s.z + p[3] * s.w); };
    return {dot(plane[0]), dot(plane[1])};
  }
};

struct Vector {
  V x, y, z;
};
HWY_INLINE V dot(const Vector& a, const Vector& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
HWY_INLINE V largest_of(const Vector& a) {
  return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}

// A patch whose degrees are known when compiling, or `dynamic`.
template <int DegreeU, int DegreeV>
struct LaneRectangle {
  static constexpr bool rectangle = true;
  const NewtonPatch& patch;
  HWY_ATTR HWY_INLINE bool bends() const { return patch.m > 1 && patch.n > 1; }
  HWY_ATTR PointJet<Lanes> first(Pair<Lanes> p) const {
    return first_order<DegreeU, DegreeV, Lanes>(patch.points, patch.m, patch.n, p.x, p.y);
  }
  HWY_ATTR PointBend<Lanes> second(Pair<Lanes> p) const {
    return second_order<DegreeU, DegreeV, Lanes>(patch.points, patch.m, patch.n, p.x, p.y);
  }
};

template <int Degree>
struct LaneTriangle {
  static constexpr bool rectangle = false;
  const NewtonPatch& patch;
  HWY_ATTR HWY_INLINE bool bends() const { return patch.m > 1; }
  HWY_ATTR PointJet<Lanes> first(Pair<Lanes> p) const {
    return first_order<Degree, Lanes>(patch.points, patch.m, p.x, p.y);
  }
  HWY_ATTR PointBend<Lanes> second(Pair<Lanes> p) const {
    return second_order<Degree, Lanes>(patch.points, patch.m, p.x, p.y);
  }
};
