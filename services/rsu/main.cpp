#include "services/rsu/process/run_rsu.hpp"

int main(int argc, char** argv) { return lukou::run_shipped_rsu(argc, argv); }
