// expect: spate: never said
int main() {}
