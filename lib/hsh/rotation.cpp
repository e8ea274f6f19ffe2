#include "hsh/rotation.h"
