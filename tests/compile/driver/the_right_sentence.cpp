// expect: spate: the spacing must be positive; give it
template <class T>
void fill(T)
{
    static_assert(sizeof(T) == 0, "spate: the spacing must be positive; give it in metres");
}
int main() { fill(1); }
