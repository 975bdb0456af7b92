// Holds a flat image against another.
#include <bdpt/eval/metric.h>
#include <bdpt/image.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main()
{
    const bdpt::Image reference{4, 4, std::vector<bdpt::Rgb>(16, bdpt::Rgb(1.0f))};
    const bdpt::Image image{4, 4, std::vector<bdpt::Rgb>(16, bdpt::Rgb(1.5f))};
    using bdpt::eval::Metric;
    const double error = bdpt::eval::evaluate(Metric::relmse, image, reference);
    const double flip = bdpt::eval::evaluate(Metric::flip, image, reference);
    std::printf("relMSE %g, FLIP %g\n", error, flip);
    return std::abs(error - 0.25 / 1.01) < 1e-12 && flip > 0.0 ? 0 : 1;
}
