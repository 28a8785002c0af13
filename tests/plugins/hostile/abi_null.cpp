extern "C" const char* rondure_plugin_abi() { return nullptr; }
extern "C" void rondure_plugin_register(void*) {}
