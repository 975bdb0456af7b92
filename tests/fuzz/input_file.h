#pragma once

#include "scratch_folder.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace bdpt::fuzz {

/// The only file in a folder of its own; each input replaces what it held.
class InputFile {
public:
    [[nodiscard]] std::filesystem::path write(const std::uint8_t* data, std::size_t size) const
    {
        const std::filesystem::path file = folder_ / "input";
        std::filesystem::remove(file);  // Some file systems wait for the disk where one is cut off.
        std::ofstream stream(file, std::ios::binary | std::ios::trunc);
        stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        if (!stream.flush()) {
            throw std::runtime_error("cannot write " + file.string());
        }
        return file;
    }

private:
    test::ScratchFolder folder_;
};

}  // namespace bdpt::fuzz
