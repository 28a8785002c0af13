// Built for a Rondure that never was; registering would end the process.
#include <cstdlib>

namespace rondure {
class Registry;
}

extern "C" const char* rondure_plugin_abi() { return "rondure 0.0.1 abi 0"; }
extern "C" void rondure_plugin_register(rondure::Registry*) { std::abort(); }
