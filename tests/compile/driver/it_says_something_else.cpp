// expect: spate: the spacing must be positive
static_assert(sizeof(int) == 0, "spate: something else"); // spate: the spacing must be positive
