// bdpt-read-vdb: reads a grid of an OpenVDB file for the library, which starts it (see
// volume/vdb_reply.h). OpenVDB may crash, never end or request all memory on broken files, which
// ends only this process.

#include <bdpt/error.h>

#include "process/limited_process.h"
#include "vdb_reader/dense_densities.h"
#include "vdb_reader/grid_choice.h"
#include "vdb_reader/whole_file.h"
#include "volume/vdb_reply.h"

#include <openvdb/openvdb.h>

#include <oneapi/tbb/global_control.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string>

namespace bdpt::vdb {
namespace {

void read(const std::string& name, const std::string& wanted, std::uint64_t max_bytes,
          io::Allowance allowance)
{
    openvdb::initialize();
    io::confine(io::Openable::to_read);
    check_whole_file(name);
    openvdb::io::File file(name);
    file.open(/*delayLoad=*/false);
    io::confine(io::Openable::none);
    const openvdb::GridBase::Ptr grid = file.readGrid(chosen_grid(file, wanted));
    const io::VdbReply header = make_header(*grid, max_bytes);
    io::write_output(&header, sizeof(header));
    // From here on the work is proportional to the densities, which `make_header` has limited.
    constexpr std::uint64_t bytes_per_second = std::uint64_t{64} << 20U;
    allowance.memory += slab_bytes(header);
    allowance.seconds += density_bytes(header) / bytes_per_second;
    io::allow(allowance);
    write_densities(*grid, header, [](std::span<const float> densities) {
        io::write_output(densities.data(), densities.size_bytes());
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
    if (words.size() != 6) {
        return failed(ErrorCode::usage,
                      "expected FILE GRID BYTES MEMORY SECONDS; bdpt --volume starts it");
    }
    const auto number = [&](std::size_t word) { return std::strtoull(words[word], nullptr, 10); };
    const io::Allowance allowance{.memory = number(4), .seconds = number(5)};
    io::limit_process(allowance);
    // Threads would take address space without a benefit: reading is not parallel.
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    try {
        read(words[1], words[2], number(3), allowance);
        return 0;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const openvdb::LookupError& error) {  // unknown type of grid or transform
        return failed(ErrorCode::unsupported, plain(error.what(), 200));
    } catch (const std::bad_alloc&) {
        return failed(ErrorCode::invalid_input, "broken, or too large: its tree takes more than " +
                                                    std::to_string(allowance.memory) +
                                                    " bytes, the limit for a file of its size");
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
