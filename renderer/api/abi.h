// The string that a plugin and its host must agree on before either calls the other.
//
// It is made at compile time, so that it always tells of the code that holds it: an ordinary inline function
// would be merged with the host's copy when the plugin is loaded, and every plugin would match.
#pragma once

#include <cstddef>
#include <string_view>

#include "renderer/api/integrator.h"
#include "renderer/api/registry.h"
#include "renderer/api/surface.h"
#include "renderer/api/version.h"

namespace rondure {

// Raise when the meaning of a plugin interface changes although every size stays the same.
inline constexpr int abi_number = 2;

struct AbiString {
  char text[320] = {};
  std::size_t length = 0;

  consteval AbiString& add(std::string_view part) {
    for (const char c : part) text[length++] = c;  // overflow would not compile
    return *this;
  }
  consteval AbiString& add(std::size_t number) {
    if (number >= 10) add(number / 10);
    text[length++] = static_cast<char>('0' + number % 10);
    return *this;
  }
  template <class T>
  consteval AbiString& add_layout(std::string_view name) {
    return add(" ").add(name).add(":").add(sizeof(T)).add("/").add(alignof(T));
  }
};

// "rondure 0.1.0 abi 1 gcc 12 libstdc++ cxx11 address-sanitizer Net:64/8 ...": the last part lists
// size/alignment.
consteval AbiString abi_string() {
  AbiString abi;
  abi.add("rondure ").add(version).add(" abi ").add(std::size_t{abi_number});
#if defined(__clang__)
  abi.add(" clang ").add(std::size_t{__clang_major__});
#elif defined(__GNUC__)
  abi.add(" gcc ").add(std::size_t{__GNUC__});
#else
  abi.add(" unknown-compiler");
#endif
#if defined(_LIBCPP_VERSION)
  abi.add(" libc++");
#elif defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
  abi.add(" libstdc++ cxx11");
#else
  abi.add(" libstdc++ old");
#endif
#if defined(_GLIBCXX_DEBUG)
  abi.add(" debug-containers");
#endif
#if defined(__SANITIZE_ADDRESS__)
  abi.add(" address-sanitizer");
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  abi.add(" address-sanitizer");
#endif
#endif
  abi.add_layout<dvec4>("dvec4").add_layout<Net>("Net").add_layout<Surface>("Surface");
  abi.add_layout<Value>("Value").add_layout<Params>("Params").add_layout<SurfaceFamily>("SurfaceFamily");
  abi.add_layout<IntegratorFactory>("IntegratorFactory")
      .add_layout<LayerFactory>("LayerFactory")
      .add_layout<Registry>("Registry");
  abi.add_layout<Ray>("Ray").add_layout<Hit>("Hit").add_layout<Sampler>("Sampler").add_layout<World>("World");
  return abi;
}

}  // namespace rondure
