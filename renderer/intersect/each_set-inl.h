// Includes the file that COMPILED_FOR_EACH_SET names, once for each of the instruction sets (instructions.h),
// within a namespace of its own. FOR_THIS_SET makes a function be compiled for the set (the pragma alone forgets
// templates). To be included where that namespace belongs; hence no guard and no include.

namespace baseline {
#define FOR_THIS_SET
#define INLINE_FOR_THIS_SET [[gnu::always_inline]] inline
#define POINT_IN_ONE_REGISTER 0
#include COMPILED_FOR_EACH_SET
#undef FOR_THIS_SET
#undef INLINE_FOR_THIS_SET
#undef POINT_IN_ONE_REGISTER
}  // namespace baseline

#ifdef __x86_64__
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
#define POINT_IN_ONE_REGISTER 1
#define FOR_THIS_SET __attribute__((target("avx2")))
#define INLINE_FOR_THIS_SET __attribute__((target("avx2"), always_inline)) inline
#include COMPILED_FOR_EACH_SET
#undef FOR_THIS_SET
#undef INLINE_FOR_THIS_SET
#undef POINT_IN_ONE_REGISTER
}  // namespace avx2
#pragma GCC pop_options
#endif
#undef COMPILED_FOR_EACH_SET
