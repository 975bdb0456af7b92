// bdpt-read-ktx: decodes a KTX2 image for the library, which starts it (see
// process/reader_program.h). libktx may crash or request all memory on broken files, which ends
// only this process.

#include <bdpt/error.h>
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "process/reader_program.h"

namespace bdpt::ktx {
namespace {

struct Texture;

/// The start of the table of functions that each texture points to (ktxTexture_vtbl).
struct TextureFunctions {
    void (*Destroy)(Texture* texture);
    int (*GetImageOffset)(Texture* texture, std::uint32_t level, std::uint32_t layer,
                          std::uint32_t face, std::size_t* offset);
};

/// The start of a texture of libktx (ktxTexture), which macros of its header read.
struct Texture {
    int class_id;
    TextureFunctions* functions;
};

/// The used part of the C interface of libktx 4, by the names of its documentation. Errors and
/// formats are plain numbers.
struct KtxFunctions {
    int (*ktxTexture2_CreateFromMemory)(const std::uint8_t* bytes, std::size_t size,
                                        std::uint32_t flags, Texture** texture);
    bool (*ktxTexture2_NeedsTranscoding)(Texture* texture);
    int (*ktxTexture2_TranscodeBasis)(Texture* texture, int format, std::uint32_t flags);
    std::uint8_t* (*ktxTexture_GetData)(Texture* texture);
    std::size_t (*ktxTexture_GetDataSize)(Texture* texture);
    const char* (*ktxErrorString)(int error);

    static constexpr std::uint32_t create_load_image_data = 1;
    static constexpr int format_rgba32 = 13;
    static constexpr int success = 0;
    static constexpr int out_of_memory = 13;
};

namespace fs = std::filesystem;

/// Names of the library in packages, and in builds without a version.
constexpr const char* library_names[] = {"libktx.so.4", "libktx.so"};

std::vector<std::string> files_to_try(const std::string& library)
{
    if (library.empty()) {
        return {library_names[0], library_names[1]};
    }
    std::error_code error;
    // A name without a slash would be searched in the system's folders.
    const fs::path path = fs::absolute(library, error);
    if (!fs::is_directory(path, error)) {
        return {path.string()};
    }
    return {(path / library_names[0]).string(), (path / library_names[1]).string()};
}

template <typename Function>
void find(void* module, const std::string& file, const char* name, Function*& function)
{
    void* const address = dlsym(module, name);
    if (address == nullptr) {
        throw Error(ErrorCode::unsupported, file + " is not libktx 4: it has no " + name);
    }
    function = reinterpret_cast<Function*>(address);
}

/// Opens the library, a file or a folder with libktx.so.4 or libktx.so, and resolves its functions;
/// an empty name: the library that the system finds. Throws `Error` (unsupported).
KtxFunctions open_ktx(const std::string& library)
{
    std::string reason;
    for (const std::string& file : files_to_try(library)) {
        void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module == nullptr) {
            reason = reason.empty() ? dlerror() : reason;  // the error of the likelier name
            continue;
        }
        KtxFunctions functions{};
        find(module, file, "ktxTexture2_CreateFromMemory", functions.ktxTexture2_CreateFromMemory);
        find(module, file, "ktxTexture2_NeedsTranscoding", functions.ktxTexture2_NeedsTranscoding);
        find(module, file, "ktxTexture2_TranscodeBasis", functions.ktxTexture2_TranscodeBasis);
        find(module, file, "ktxTexture_GetData", functions.ktxTexture_GetData);
        find(module, file, "ktxTexture_GetDataSize", functions.ktxTexture_GetDataSize);
        find(module, file, "ktxErrorString", functions.ktxErrorString);
        return functions;
    }
    throw Error(ErrorCode::unsupported,
                "libktx was not found: " + reason +
                    ". libktx 4 is part of https://github.com/KhronosGroup/KTX-Software");
}

/// Size according to the header of the image.
struct Size {
    std::size_t width = 0;
    std::size_t height = 0;
    std::size_t channels = 0;

    [[nodiscard]] std::size_t pixels() const { return width * height; }
};

/// Returns the file on the standard input.
std::span<const std::uint8_t> input()
{
    struct stat info {};
    const bool known = fstat(STDIN_FILENO, &info) == 0 && info.st_size > 0;
    const auto size = static_cast<std::size_t>(known ? info.st_size : 0);
    void* const bytes =
        known ? mmap(nullptr, size, PROT_READ, MAP_PRIVATE, STDIN_FILENO, 0) : MAP_FAILED;
    if (bytes == MAP_FAILED) {
        throw Error(ErrorCode::not_found, "its standard input is no file");
    }
    return {static_cast<const std::uint8_t*>(bytes), size};
}

void check(const KtxFunctions& ktx, int error)
{
    if (error == KtxFunctions::out_of_memory) {
        throw std::bad_alloc();
    }
    if (error != KtxFunctions::success) {
        throw Error(ErrorCode::invalid_input,
                    std::string("broken: libktx says: ") + ktx.ktxErrorString(error));
    }
}

/// Writes the first `channels` of the `stride` values of each pixel.
void write_pixels(std::span<const std::uint8_t> values, std::size_t stride, std::size_t channels)
{
    if (stride == channels) {
        return io::write_output(values.data(), values.size());
    }
    constexpr std::size_t pixels_at_once = 16384;
    std::vector<std::uint8_t> packed;
    for (std::size_t done = 0; done < values.size();) {
        const std::size_t end = std::min(values.size(), done + pixels_at_once * stride);
        packed.clear();
        for (; done < end; done += stride) {
            const auto pixel = values.subspan(done, channels);
            packed.insert(packed.end(), pixel.begin(), pixel.end());
        }
        io::write_output(packed.data(), packed.size());
    }
}

void decode(const KtxFunctions& ktx, std::span<const std::uint8_t> file, const Size& size)
{
    Texture* texture = nullptr;
    check(ktx, ktx.ktxTexture2_CreateFromMemory(file.data(), file.size(),
                                                KtxFunctions::create_load_image_data, &texture));
    std::size_t stride = size.channels;
    if (ktx.ktxTexture2_NeedsTranscoding(texture)) {
        check(ktx, ktx.ktxTexture2_TranscodeBasis(texture, KtxFunctions::format_rgba32, 0));
        stride = 4;
    }
    std::size_t offset = 0;
    check(ktx, texture->functions->GetImageOffset(texture, 0, 0, 0, &offset));
    const std::span<const std::uint8_t> data(ktx.ktxTexture_GetData(texture),
                                             ktx.ktxTexture_GetDataSize(texture));
    const std::size_t bytes = size.pixels() * stride;
    if (offset > data.size() || bytes > data.size() - offset) {
        throw Error(ErrorCode::invalid_input, "broken: libktx decodes another size");
    }
    write_pixels(data.subspan(offset, bytes), stride, size.channels);
}

int failed(ErrorCode code, std::string message)
{
    constexpr std::size_t most = 4000;
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
    std::fprintf(stderr, "bdpt-read-ktx: %s\n", message.substr(0, most).c_str());
    return static_cast<int>(code);
}

int run(std::span<char*> words)
{
    if (words.size() != 2 && words.size() != 7) {
        return failed(ErrorCode::usage,
                      "expected LIBRARY, or LIBRARY WIDTH HEIGHT CHANNELS MEMORY SECONDS; bdpt "
                      "starts it");
    }
    const auto number = [&](std::size_t word) { return std::strtoull(words[word], nullptr, 10); };
    const bool decodes = words.size() == 7;
    const io::Allowance allowance = decodes
                                        ? io::Allowance{.memory = number(5), .seconds = number(6)}
                                        : io::Allowance{.memory = 0, .seconds = 10};
    io::limit_process(allowance);
    try {
        const KtxFunctions ktx = open_ktx(words[1]);
        const io::KtxReply reply;
        io::write_output(&reply, sizeof(reply));
        io::confine(io::Openable::none);
        if (decodes) {
            decode(ktx, input(), {.width = number(2), .height = number(3), .channels = number(4)});
        }
        return 0;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return failed(ErrorCode::invalid_input, "broken, or too large: decoding takes more than " +
                                                    std::to_string(allowance.memory) +
                                                    " bytes, the limit for an image of its size");
    } catch (const std::exception& error) {
        return failed(ErrorCode::invalid_input, std::string("broken: ") + error.what());
    }
}

}  // namespace

}  // namespace bdpt::ktx

int main(int count, char** words)
{
    const int code = bdpt::ktx::run({words, static_cast<std::size_t>(count)});
    std::fflush(stderr);
    // No clean-up of what libktx or a broken file left behind.
    _exit(code);
}
