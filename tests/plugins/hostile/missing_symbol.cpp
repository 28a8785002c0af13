// Needs a function that nobody has.
extern "C" void rondure_no_such_function();
extern "C" const char* rondure_plugin_abi() { return "rondure"; }
extern "C" void rondure_plugin_register(void*) { rondure_no_such_function(); }
