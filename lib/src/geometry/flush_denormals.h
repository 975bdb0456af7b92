#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace bdpt {

/// Flushes denormal floats to zero on the calling thread, as Embree recommends, and restores the
/// thread's previous mode in the destructor. On processors other than x86 and aarch64 it does
/// nothing: results differ only where a value is below 1.2e-38.
class FlushDenormals {
public:
    FlushDenormals() : before_(mode()) { set_mode(before_ | flush_bits); }
    ~FlushDenormals() { set_mode(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__SSE__)
    using Mode = unsigned;
    static constexpr Mode flush_bits = _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON;
    static Mode mode()
    {
        return _mm_getcsr();
    }
    static void set_mode(Mode mode)
    {
        _mm_setcsr(mode);
    }
#elif defined(__aarch64__)
    using Mode = std::uint64_t;
    static constexpr Mode flush_bits = Mode{1} << 24;  // FZ of FPCR
    static Mode mode()
    {
        Mode mode;
        asm volatile("mrs %0, fpcr" : "=r"(mode));
        return mode;
    }
    static void set_mode(Mode mode)
    {
        asm volatile("msr fpcr, %0" : : "r"(mode));
    }
#else
    using Mode = unsigned;
    static constexpr Mode flush_bits = 0;
    static Mode mode()
    {
        return 0;
    }
    static void set_mode(Mode) {}
#endif

    Mode before_;
};

}  // namespace bdpt
