// Ends the process while it is loaded.
#include <cstdlib>

namespace {
const int value = [] {
  std::_Exit(3);
  return 0;
}();
}  // namespace

extern "C" const char* rondure_plugin_abi() { return value == 0 ? "rondure" : ""; }
extern "C" void rondure_plugin_register(void*) {}
