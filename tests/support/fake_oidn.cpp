// A library with the interface of Open Image Denoise 2 that computes a simple function instead of
// denoising: layers are "denoised" by adding 1 to albedo and 2 to normals, images by 2 * color +
// albedo + normal. It fails unless it is told that images are of high dynamic range and, with
// layers, that these are clean or that it must be fast. With BDPT_FAKE_OIDN=fail in the environment
// each filter fails.

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace {

const char* fault = nullptr;

struct FakeFilter {
    std::map<std::string, float*> images;
    std::map<std::string, bool> flags;
    bool (*goes_on)(void*, double) = nullptr;
    void* argument = nullptr;
    bool is_fast = false;
    std::size_t values = 0;
    void run();
};

void FakeFilter::run()
{
    const char* wish = std::getenv("BDPT_FAKE_OIDN");
    const bool has_color = images.count("color") != 0;
    const bool has_layers = images.count("albedo") + images.count("normal") > 0;
    if (wish != nullptr && std::strcmp(wish, "fail") == 0) {
        fault = "it was asked to fail";
    } else if (has_color && !flags["hdr"]) {
        fault = "not told that the image is of high dynamic range";
    } else if (has_color && has_layers && flags["cleanAux"] == is_fast) {
        fault = is_fast ? "told that layers are clean" : "not told that layers are clean";
    } else if (goes_on != nullptr && !goes_on(argument, 0.5)) {
        fault = "cancelled";
    }
    float* output = images["output"];
    for (std::size_t i = 0; i < values && fault == nullptr; ++i) {
        output[i] = 0.0f;
        for (const auto& [name, input] : images) {
            if (name == "color") {
                output[i] += 2.0f * input[i];
            } else if (name != "output") {
                const float offset = has_color ? 0.0f : name == "albedo" ? 1.0f : 2.0f;
                output[i] += input[i] + offset;
            }
        }
    }
}

int device = 0;

}  // namespace

#define FAKE extern "C" __attribute__((visibility("default")))

FAKE void* oidnNewDevice(int type)
{
    constexpr int cpu = 1;
    return type == cpu ? &device : nullptr;
}
FAKE void oidnSetDeviceInt(void*, const char*, int) {}
FAKE int oidnGetDeviceInt(void*, const char* name)
{
    return std::strcmp(name, "versionMajor") == 0   ? 2
           : std::strcmp(name, "versionMinor") == 0 ? 71
                                                    : 8;
}
FAKE void oidnCommitDevice(void*) {}
FAKE int oidnGetDeviceError(void*, const char** message)
{
    const int code = fault != nullptr ? 1 : 0;
    *message = fault;
    fault = nullptr;
    return code;
}
FAKE void oidnReleaseDevice(void*) {}
FAKE void* oidnNewFilter(void*, const char*)
{
    return new FakeFilter;
}
FAKE void oidnSetSharedFilterImage(void* filter, const char* name, void* pointer, int,
                                   std::size_t width, std::size_t height, std::size_t, std::size_t,
                                   std::size_t)
{
    auto* fake = static_cast<FakeFilter*>(filter);
    fake->images[name] = static_cast<float*>(pointer);
    fake->values = 3 * width * height;
}
FAKE void oidnSetFilterBool(void* filter, const char* name, bool value)
{
    static_cast<FakeFilter*>(filter)->flags[name] = value;
}
FAKE void oidnSetFilterInt(void* filter, const char* name, int value)
{
    constexpr int fast = 4;
    static_cast<FakeFilter*>(filter)->is_fast = std::strcmp(name, "quality") == 0 && value == fast;
}
FAKE void oidnSetFilterProgressMonitorFunction(void* filter, bool (*goes_on)(void*, double),
                                               void* argument)
{
    static_cast<FakeFilter*>(filter)->goes_on = goes_on;
    static_cast<FakeFilter*>(filter)->argument = argument;
}
FAKE void oidnCommitFilter(void*) {}
FAKE void oidnExecuteFilter(void* filter)
{
    static_cast<FakeFilter*>(filter)->run();
}
FAKE void oidnReleaseFilter(void* filter)
{
    delete static_cast<FakeFilter*>(filter);
}
