#include <stdexcept>

extern "C" const char* rondure_plugin_abi() { throw std::runtime_error("no ABI today"); }
extern "C" void rondure_plugin_register(void*) {}
