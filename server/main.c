#include "commands.h"

int main(int argc, char **argv) { return fairlead_main(argc, argv); }
