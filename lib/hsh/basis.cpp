#include "hsh/basis.h"
