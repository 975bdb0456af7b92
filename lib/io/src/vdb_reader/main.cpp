// bdpt-read-vdb: reads a grid of an OpenVDB file for the library, which starts it
// (volume/vdb_reply.h says how). OpenVDB may crash, never end or ask for all memory on broken
// files: that ends this process and no other.

#include <bdpt/error.h>

#include "vdb_reader/dense_densities.h"
#include "vdb_reader/grid_choice.h"
#include "vdb_reader/whole_file.h"
#include "volume/vdb_reply.h"

#include <openvdb/openvdb.h>

#include <oneapi/tbb/global_control.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string>

namespace bdpt::vdb {
namespace {

void limit(decltype(RLIMIT_AS) resource, std::uint64_t most)
{
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min<rlim_t>(limits.rlim_max, most);
    setrlimit(resource, &limits);
}

/// Before anything is read. Signals to a group of processes are for who started this, and this ends
/// with that.
void limit_process(std::uint64_t bytes, std::uint64_t seconds)
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        signal(number, SIG_IGN);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, seconds);
    limit(RLIMIT_FSIZE, 1U << 20U);  // of messages
#ifndef BDPT_SANITIZED               // sanitizers take far more, but do not use it
    // The tree of a grid may be larger than what it stands for: leaves are full, and may hold
    // doubles.
    constexpr std::uint64_t program = std::uint64_t{512} << 20U;
    limit(RLIMIT_AS, bytes > UINT64_MAX / 8 ? RLIM_INFINITY : 3 * bytes + program);
#endif
}

void write(const void* bytes, std::size_t size)
{
    const auto* next = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t count = ::write(STDOUT_FILENO, next, size);
        if (count < 0 && errno != EINTR) {
            throw Error(ErrorCode::output, "nobody reads what it writes");
        }
        next += std::max<ssize_t>(count, 0);
        size -= static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

void read(const std::string& name, const std::string& wanted, std::uint64_t most_bytes)
{
    openvdb::initialize();
    check_whole_file(name);
    openvdb::io::File file(name);
    file.open(/*delayLoad=*/false);
    const openvdb::GridBase::Ptr grid = file.readGrid(chosen_grid(file, wanted));
    const io::VdbReply header = header_of(*grid, most_bytes);
    write(&header, sizeof(header));
    write_densities(*grid, header, [](std::span<const float> densities) {
        write(densities.data(), densities.size_bytes());
    });
}

int failed(ErrorCode code, const std::string& message)
{
    constexpr std::size_t most = 4000;
    std::fprintf(stderr, "bdpt-read-vdb: %s\n", plain(message, most).c_str());
    return static_cast<int>(code);
}

int run(std::span<char*> words)
{
    if (words.size() != 5) {
        return failed(ErrorCode::usage,
                      "expected FILE GRID BYTES SECONDS; bdpt --volume starts it");
    }
    const std::uint64_t bytes = std::strtoull(words[3], nullptr, 10);
    limit_process(bytes, std::strtoull(words[4], nullptr, 10));
    // Threads would take address space, and change nothing: reading is not parallel.
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    try {
        read(words[1], words[2], bytes);
        return 0;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const openvdb::LookupError& error) {  // a type of grid or transform
        return failed(ErrorCode::unsupported, plain(error.what(), 200));
    } catch (const std::bad_alloc&) {
        return failed(ErrorCode::invalid_input,
                      "broken, or too large: more memory is asked for than for densities of " +
                          std::to_string(bytes) + " bytes, which is the limit");
    } catch (const std::exception& error) {
        return failed(ErrorCode::invalid_input, std::string("broken: ") + plain(error.what(), 200));
    }
}

}  // namespace
}  // namespace bdpt::vdb

int main(int count, char** words)
{
    return bdpt::vdb::run({words, static_cast<std::size_t>(count)});
}
