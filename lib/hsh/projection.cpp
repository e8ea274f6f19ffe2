#include "hsh/projection.h"
