// A point of four coordinates as the vectors of one instruction set hold it. Included inside the namespace of
// an instruction set, which FOR_THIS_SET names, POINT_IN_ONE_REGISTER being 1 where four doubles fit in one;
// hence no guard and no include.

struct OnePoint {
  using Number = double;
#if POINT_IN_ONE_REGISTER
  using Point = double __attribute__((vector_size(32)));
#else
  using Point = detail::Lanes4;
#endif
  FOR_THIS_SET static double lift(double x) { return x; }
  FOR_THIS_SET static Point zero() { return Point{}; }
  FOR_THIS_SET static Point load(const dvec4& p) {
    Point out;
    std::memcpy(&out, &p, sizeof out);
    return out;
  }
  FOR_THIS_SET static dvec4 store(const Point& p) {
    dvec4 out;
    std::memcpy(&out, &p, sizeof out);
    return out;
  }
};
