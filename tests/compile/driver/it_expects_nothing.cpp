static_assert(sizeof(int) == 0, "spate: a sentence");
