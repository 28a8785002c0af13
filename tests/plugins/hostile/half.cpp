// Has one of the two entry points.
extern "C" const char* rondure_plugin_abi() { return "rondure"; }
