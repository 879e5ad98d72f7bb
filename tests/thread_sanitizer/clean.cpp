#include <cstdio>
#include <vector>

int main()
{
    std::vector<double> a(100000, 1.0);
    double sum = 0;
    for (int round = 0; round < 20; ++round) {
#pragma omp parallel num_threads(4)
        {
#pragma omp for schedule(dynamic, 64)
            for (int i = 0; i < 100000; ++i) a[i] += 0.5 * i;
#pragma omp for reduction(+ : sum)
            for (int i = 0; i < 100000; ++i) sum += a[99999 - i]; // written by another thread, before a barrier
#pragma omp single
            a[0] = round;
#pragma omp for reduction(+ : sum)
            for (int i = 0; i < 100000; ++i) sum += a[0];
        }
    }
    std::printf("%g\n", sum);
}
