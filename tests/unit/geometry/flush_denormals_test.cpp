#include "geometry/flush_denormals.h"

#include "catch.hpp"

#include <limits>

namespace bdpt::flush_denormals_test {
namespace {

#if defined(__SSE__) || defined(__aarch64__)
constexpr bool flushes = true;
#else
constexpr bool flushes = false;
#endif

/// Half of the smallest normal float, calculated when it is called.
float denormal()
{
    volatile float smallest = std::numeric_limits<float>::min();
    return smallest * 0.5f;
}

TEST_CASE("denormals are zero while an object says so, and exist again afterwards", "[geometry]")
{
    {
        const FlushDenormals flush;
        CHECK((denormal() == 0.0f) == flushes);
        {
            const FlushDenormals again;
        }
        CHECK((denormal() == 0.0f) == flushes);
    }
    CHECK(denormal() != 0.0f);
}

}  // namespace
}  // namespace bdpt::flush_denormals_test
