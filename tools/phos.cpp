// phos: runs the programs of phos, explains them, and checks the machine.
#include "stage/front/front.h"

int main(int argc, char** argv) { return phos::stage::run_front(argc, argv); }
