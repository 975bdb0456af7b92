#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

#include "catch.hpp"
#include "scratch_folder.h"

// What is at the name of an output stays what it is.

namespace bdpt::io::output_target_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

void write(const fs::path& file, std::string_view text)
{
    OutputFile output(file);
    output.write(text);
    output.commit();
}

/// Why `file` cannot be written; empty: it can.
std::string refusal(const fs::path& file)
{
    try {
        write(file, "text");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::output);
        return error.what();
    }
    return "";
}

struct stat status_of(const fs::path& file)
{
    struct stat status {};
    REQUIRE(::lstat(file.c_str(), &status) == 0);
    return status;
}

TEST_CASE("a file that is replaced keeps its mode", "[output]")
{
    const mode_t mode = GENERATE(0600U, 0640U, 0644U, 0777U, 0200U);
    const ScratchFolder folder;
    test::write_text(folder / "a.exr", "old");
    REQUIRE(::chmod((folder / "a.exr").c_str(), mode) == 0);
    OutputFile output(folder / "a.exr");
    output.write(std::string_view("new"));
    for (const std::string& name : folder.names()) {
        CHECK((status_of(folder / name).st_mode & 0777U & ~mode) == 0);
    }
    output.commit();
    CHECK((status_of(folder / "a.exr").st_mode & 07777U) == mode);
}

TEST_CASE("a file that root replaces keeps its owner", "[output]")
{
    if (::geteuid() != 0) {
        WARN("skipped: only root gives files away");
        return;
    }
    const ScratchFolder folder;
    test::write_text(folder / "a.exr", "old");
    REQUIRE(::chown((folder / "a.exr").c_str(), 12345, 23456) == 0);
    write(folder / "a.exr", "new");
    CHECK(status_of(folder / "a.exr").st_uid == 12345);
    CHECK(status_of(folder / "a.exr").st_gid == 23456);
    CHECK(test::read_text(folder / "a.exr") == "new");
}

TEST_CASE("a name may be as long as the file system allows", "[output]")
{
    const ScratchFolder folder;
    const std::size_t length = GENERATE(std::size_t{180}, 213, 214, 254, 255);
    const std::string name = std::string(length - 4, 'a') + ".exr";
    write(folder / name, "text");
    CHECK(test::read_text(folder / name) == "text");
    CHECK(folder.names().size() == 1);
    // Cut between characters.
    std::string umlauts;
    while (umlauts.size() + 2 <= 250) {
        umlauts += "\xc3\xbc";
    }
    const std::string temporary = OutputFile::temporary_path(folder / umlauts).filename().string();
    CHECK(temporary.size() <= 250);
    CHECK(temporary.find(".tmp-") % 2 == 0);
}

TEST_CASE("a name of more than 255 bytes is refused before anything is written", "[output]")
{
    const ScratchFolder folder;
    CHECK(refusal(folder / std::string(256, 'a')).find("File name too long") != std::string::npos);
}

TEST_CASE("a link to a file that is not there makes that file", "[output]")
{
    const ScratchFolder folder;
    fs::create_directory(folder / "real");
    fs::create_symlink("real/a.exr", folder / "link.exr");
    fs::create_symlink("link.exr", folder / "again.exr");
    write(folder / "again.exr", "text");
    CHECK(fs::is_symlink(folder / "again.exr"));
    CHECK(fs::is_symlink(folder / "link.exr"));
    CHECK(test::read_text(folder / "real/a.exr") == "text");
}

TEST_CASE("links that lead nowhere are refused and stay", "[output]")
{
    const ScratchFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    CHECK(refusal(folder / "a").find("levels of symbolic links") != std::string::npos);
    fs::create_symlink("missing/c", folder / "c");
    CHECK(refusal(folder / "c").find("there is no folder") != std::string::npos);
    CHECK(fs::is_symlink(folder / "a"));
    CHECK(fs::is_symlink(folder / "c"));
}

TEST_CASE("a named pipe is written into", "[output]")
{
    const ScratchFolder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("pipe", folder / "link");
    const char* name = GENERATE("pipe", "link");
    check_writable(folder / name);
    std::string text;
    std::thread reader([&] { text = test::read_text(folder / "pipe"); });
    const std::string large(1 << 20, 'x');
    write(folder / name, large);
    reader.join();
    CHECK(text == large);
    CHECK(S_ISFIFO(status_of(folder / "pipe").st_mode));
    CHECK(folder.names().size() == 2);
}

TEST_CASE("a device is written into, also by root", "[output]")
{
    if (::geteuid() != 0) {
        write("/dev/null", "text");
        CHECK(refusal("/dev/full").find("No space left") != std::string::npos);
        WARN("skipped: only root makes devices, and loses those of the system by a defect");
        return;
    }
    const ScratchFolder folder;
    REQUIRE(::mknod((folder / "full").c_str(), S_IFCHR | 0600, makedev(1, 7)) == 0);
    CHECK(refusal(folder / "full").find("No space left") != std::string::npos);
    REQUIRE(::mknod((folder / "null").c_str(), S_IFCHR | 0600, makedev(1, 3)) == 0);
    REQUIRE(::mknod((folder / "disk").c_str(), S_IFBLK | 0600, makedev(7, 99)) == 0);
    fs::create_symlink("null", folder / "link");
    write(folder / "null", "text");
    write(folder / "link", "text");
    CHECK(S_ISCHR(status_of(folder / "null").st_mode));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(refusal(folder / "disk").find("this is a block device") != std::string::npos);
    CHECK(S_ISBLK(status_of(folder / "disk").st_mode));
}

TEST_CASE("a socket is refused and stays", "[output]")
{
    const ScratchFolder folder;
    const std::string name = (folder / "socket").string();
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy_n(name.begin(), std::min(name.size(), sizeof(address.sun_path) - 1),
                address.sun_path);
    REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
    CHECK(refusal(name).find("this is a socket") != std::string::npos);
    CHECK(S_ISSOCK(status_of(name).st_mode));
    ::close(socket);
}

TEST_CASE("names of open descriptors lead to those", "[output]")
{
    const ScratchFolder folder;
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const std::string number = std::to_string(ends[1]);
    const std::string name = GENERATE("/dev/fd/", "/proc/self/fd/", "/proc/thread-self/fd/");
    fs::create_symlink(name + number, folder / "link");
    write(name + number, "one ");
    write(folder / "link", "two");
    ::close(ends[1]);
    std::string text(20, ' ');
    text.resize(static_cast<std::size_t>(::read(ends[0], text.data(), text.size())));
    CHECK(text == "one two");
    CHECK(refusal(name + std::to_string(ends[0])).find("read-only") != std::string::npos);
    ::close(ends[0]);
    CHECK(refusal(name + number).find("cannot write") != std::string::npos);

    // A file is written where the descriptor is in it, not replaced.
    const int file = ::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    REQUIRE(::write(file, "before ", 7) == 7);
    write(name + std::to_string(file), "after");
    ::close(file);
    CHECK(test::read_text(folder / "log") == "before after");
}

}  // namespace
}  // namespace bdpt::io::output_target_test
