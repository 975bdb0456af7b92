#include "fuzz_target.h"
#include "part/part_contents.h"
#include "promises.h"
#include "sealed_part.h"

#include <bdpt/io/part_file.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

using namespace bdpt;
using namespace bdpt::io;

namespace {

/// A file that has a name, but is on no disk.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("part", MFD_CLOEXEC))
    {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        fuzz::promise(written == static_cast<ssize_t>(bytes.size()), "there is memory for a file");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    [[nodiscard]] std::filesystem::path path() const
    {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

private:
    int descriptor_;
};

/// What is read can be shown, and added once.
void read_file(std::string_view bytes)
{
    const MemoryFile file(bytes);
    const PartInfo info = read_part_info(file.path());
    fuzz::promise(!info.samples.empty(), "parts have samples");
    RenderResult part;
    merge_part(part, info);
    fuzz::promise(part.samples == info.samples && part.identity == info.identity,
                  "a part is what it says that it is");
    const Image image = part.film.develop();
    fuzz::promise(image.pixels.size() == static_cast<std::size_t>(part.film.width()) *
                                             static_cast<std::size_t>(part.film.height()),
                  "images have as many pixels as they say");
    static_cast<void>(part.aovs.develop(part.film));
    static_cast<void>(part.ids.develop(part.film));
    static_cast<void>(part.strategies.develop());
    try {
        merge_part(part, info);
    } catch (const Error& error) {
        return fuzz::check_refusal(error);
    }
    fuzz::broken("samples count once", info.samples.text());
}

/// What is understood is written in the same words.
void read_header(std::string_view text)
{
    const std::string written = to_text(parse_part_header(text));
    fuzz::promise(to_text(parse_part_header(written)) == written, "a header is read as written",
                  written);
}

template <typename Read>
void attempt(const Read& read)
{
    try {
        read();
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
}

}  // namespace

/// Parts of renders, as they are and with a seal that holds, so that what is behind it sees them,
/// too; and what a part says in JSON.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with('{')) {
        attempt([&] { read_header(bytes); });
        return 0;
    }
    attempt([&] { read_file(bytes); });
    attempt([&] { read_file(test::sealed_part(bytes)); });
    return 0;
}
