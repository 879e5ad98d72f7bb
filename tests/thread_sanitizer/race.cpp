#include <cstdio>
#include <vector>

int main()
{
    std::vector<double> a(100000, 1.0);
    double sum = 0;
#pragma omp parallel for num_threads(4)
    for (int i = 0; i < 100000; ++i) sum += a[i]; // the race: no reduction
    std::printf("%g\n", sum);
}
