// The shared library is made of the static ones. This file compiles it once against its own public headers.
#include <ursula/ursula.h>
