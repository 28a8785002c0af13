// Throws while it is loaded.
#include <stdexcept>

namespace {
const int value = [] {
  throw std::runtime_error("no loading today");
  return 0;
}();
}  // namespace

extern "C" const char* rondure_plugin_abi() { return value == 0 ? "rondure" : ""; }
extern "C" void rondure_plugin_register(void*) {}
