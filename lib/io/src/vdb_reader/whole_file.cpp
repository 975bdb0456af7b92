#include "vdb_reader/whole_file.h"

#include <bdpt/error.h>

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <ios>

namespace bdpt::vdb {

namespace {

void check_version(std::istream& file)
{
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    file.read(magic.data(), magic.size());
    file.read(reinterpret_cast<char*>(&version), sizeof(version));
    if (version > openvdb::OPENVDB_FILE_VERSION) {
        throw Error(ErrorCode::unsupported,
                    "version " + std::to_string(version) + " of the format, but OpenVDB " +
                        openvdb::getLibraryVersionString() + " reads it up to version " +
                        std::to_string(openvdb::OPENVDB_FILE_VERSION));
    }
    file.seekg(0);
}

/// Reads headers of grids, using OpenVDB's base class of archives.
class Heads : private openvdb::io::Archive {
public:
    void check(std::istream& file, std::int64_t size)
    {
        readHeader(file);
        if (!inputHasGridOffsets()) {
            return;  // written to a pipe: the ends of grids are not recorded
        }
        setFormatVersion(file);
        setLibraryVersion(file);
        openvdb::MetaMap().readMeta(file);
        const std::int32_t count = readGridCount(file);
        for (std::int32_t i = 0; i < count; ++i) {
            openvdb::io::GridDescriptor head;
            head.read(file);
            const std::int64_t end = head.getEndPos();
            if (end < file.tellg() || end > size) {
                throw Error(ErrorCode::invalid_input, "broken: grid " + std::to_string(i) +
                                                          " ends at byte " + std::to_string(end) +
                                                          " of " + std::to_string(size));
            }
            head.seekToEnd(file);
        }
    }
};

}  // namespace

void check_whole_file(const std::string& name)
{
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    if (!file) {
        throw Error(ErrorCode::not_found, "cannot be read");
    }
    const std::int64_t size = file.tellg();
    file.seekg(0);
    file.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    try {
        check_version(file);
        Heads().check(file, size);
    } catch (const std::ios_base::failure&) {
        throw Error(ErrorCode::invalid_input, "broken: ends within the headers of its grids");
    }
}

}  // namespace bdpt::vdb
