#include <bdpt/export.h>

// Called by the sanitizers in their builds, by nobody otherwise. They find what is visible only.

/// When a PNG file ends too early, libpng jumps out of OpenImageIO's callback, over the destructor
/// of a string.
extern "C" BDPT_EXPORT const char* __lsan_default_suppressions()
{
    return "leak:libOpenImageIO\n";
}

/// OpenImageIO and libstdc++ keep no frame pointers, so a quick look at the stack does not find
/// them.
extern "C" BDPT_EXPORT const char* __asan_default_options()
{
    return "fast_unwind_on_malloc=0";
}
