#include "hsh/conversion.h"
