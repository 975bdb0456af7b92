#pragma once

#include <OpenEXR/ImfIO.h>
#include <bdpt/io/output_file.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace bdpt::io {

/// Lets OpenEXR write into an `OutputFile`, which reports errors that it would swallow.
class ExrStream : public Imf::OStream {
public:
    ExrStream(OutputFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file)
    {}
    void write(const char bytes[], int count) override
    {
        file_.write({bytes, static_cast<std::size_t>(count)});
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    OutputFile& file_;
};

}  // namespace bdpt::io
