#include <spate/spate.hpp>

int main() {}
