// Called by LeakSanitizer in its builds, by nobody otherwise. When a PNG file ends too early,
// libpng jumps out of OpenImageIO's callback, over the destructor of a string.
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libOpenImageIO\n";
}
