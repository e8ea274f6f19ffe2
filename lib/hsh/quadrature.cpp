#include "hsh/quadrature.h"
