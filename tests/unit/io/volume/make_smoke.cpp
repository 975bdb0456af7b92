// Writes scenes/smoke.vdb: make_smoke FILE.

#include <cstdio>

#include "smoke_plume.h"

int main(int count, char** words)
{
    if (count != 2) {
        std::fputs("usage: make_smoke FILE\n", stderr);
        return 2;
    }
    openvdb::initialize();
    openvdb::io::File file(words[1]);
    file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write({bdpt::test::smoke_plume()});
}
