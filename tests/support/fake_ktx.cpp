// A library with the interface of libktx 4 that invents pixels: "transcoded" ones are (x, y, first
// byte of the level, 77), others have the level's contents. As in libktx, small levels come first.
// It fails unless it is told to load the image, and to transcode to RGBA where it says that this is
// needed. The name of its file selects a misbehaviour: libktx-fail.so, or -crash, -greedy
// (allocates 64 GiB), -short (decodes less than the header promises), -throw (no C++ library
// should), -write (to a file beside itself), -connect, -start (another program), -secret (fails if
// BDPT_TEST_SECRET is in the environment), -sleep (never returns).

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Texture;

struct Functions {
    void (*destroy)(Texture*);
    int (*image_offset)(Texture*, std::uint32_t, std::uint32_t, std::uint32_t, std::size_t*);
};

struct Texture {
    int class_id;
    const Functions* functions;
    std::vector<std::uint8_t> data;
    std::uint32_t width;
    std::uint32_t height;
    std::uint8_t first;
    bool basis;
};

constexpr std::size_t before = 5;  // [bytes] of unused levels
constexpr int success = 0;
constexpr int file_data_error = 1;
constexpr int invalid_operation = 10;
constexpr int invalid_value = 11;
constexpr int out_of_memory = 13;

/// Returns the name of the file that this code is in.
std::string own_file()
{
    Dl_info info{};
    static const char place = 0;
    return dladdr(&place, &info) != 0 ? info.dli_fname : "";
}

bool wants(const std::string& wish)
{
    return own_file().ends_with("libktx-" + wish + ".so");
}

/// Does what no decoder needs; returns whether that failed.
bool is_refused()
{
    if (wants("write")) {
        return ::open((own_file() + ".written").c_str(), O_WRONLY | O_CREAT, 0600) < 0;
    }
    if (wants("connect")) {
        return ::socket(AF_INET, SOCK_STREAM, 0) < 0;
    }
    if (wants("start")) {
        std::array<char, 5> name{"true"};
        const std::array<char*, 2> words{name.data(), nullptr};
        return ::execv("/bin/true", words.data()) != 0;
    }
    return wants("secret") && std::getenv("BDPT_TEST_SECRET") != nullptr;
}

int image_offset(Texture*, std::uint32_t level, std::uint32_t layer, std::uint32_t face,
                 std::size_t* offset)
{
    *offset = before;
    return level == 0 && layer == 0 && face == 0 ? success : invalid_operation;
}

const Functions functions{nullptr, image_offset};

std::uint64_t number(const std::uint8_t* bytes, std::size_t count)
{
    std::uint64_t result = 0;
    std::memcpy(&result, bytes, count);
    return result;
}

}  // namespace

#define FAKE extern "C" __attribute__((visibility("default")))

FAKE int ktxTexture2_CreateFromMemory(const std::uint8_t* bytes, std::size_t size,
                                      std::uint32_t flags, Texture** texture)
{
    if (wants("crash")) {
        std::abort();
    }
    if (wants("throw")) {
        throw std::runtime_error("no C++ exceptions");
    }
    if (wants("greedy")) {
        void* volatile memory = std::malloc(std::size_t{64} << 30U);  // not optimised away
        return memory == nullptr ? out_of_memory : success;
    }
    while (wants("sleep")) {
        ::sleep(1000);
    }
    constexpr std::uint32_t load_image_data = 1;
    if (wants("fail") || is_refused() || flags != load_image_data) {
        return file_data_error;
    }
    const std::uint64_t offset = number(bytes + 80, 8);
    const std::uint64_t length = number(bytes + 88, 8);
    if (offset + length > size) {
        return file_data_error;
    }
    auto* made = new Texture{};
    made->class_id = 2;
    made->functions = &functions;
    made->basis = number(bytes + 12, 4) == 0;
    made->width = static_cast<std::uint32_t>(number(bytes + 20, 4));
    made->height = static_cast<std::uint32_t>(number(bytes + 24, 4));
    made->first = bytes[offset];
    made->data.assign(before, 99);
    if (!made->basis) {
        made->data.insert(made->data.end(), bytes + offset, bytes + offset + length);
    }
    *texture = made;
    return success;
}
FAKE bool ktxTexture2_NeedsTranscoding(Texture* texture)
{
    return texture->basis;
}
FAKE int ktxTexture2_TranscodeBasis(Texture* texture, int format, std::uint32_t flags)
{
    constexpr int rgba32 = 13;
    if (format != rgba32 || flags != 0 || !texture->basis) {
        return invalid_value;
    }
    for (std::uint32_t y = 0; y < texture->height; ++y) {
        for (std::uint32_t x = 0; x < texture->width; ++x) {
            for (const std::uint32_t value : {x, y, std::uint32_t{texture->first}, 77U}) {
                texture->data.push_back(static_cast<std::uint8_t>(value));
            }
        }
    }
    return success;
}
FAKE std::uint8_t* ktxTexture_GetData(Texture* texture)
{
    return texture->data.data();
}
FAKE std::size_t ktxTexture_GetDataSize(Texture* texture)
{
    return texture->data.size() - (wants("short") ? 1 : 0);
}
FAKE const char* ktxErrorString(int error)
{
    return error == file_data_error ? "the file is bad" : "asked for the wrong thing";
}
