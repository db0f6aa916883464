// The shared library is made of the static ones. This file has it compiled once against its own public headers.
#include <ursula/ursula.h>
