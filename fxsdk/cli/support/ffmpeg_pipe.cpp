#include "fxsdk/cli/support/ffmpeg_pipe.h"

#include "fxsdk/cli/support/atomic_file.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fx::cli {
namespace {

base::Status ioError(const std::string& what)
{
    return {base::Code::Io, what + ": " + std::strerror(errno)};
}

std::vector<std::string> argumentsFor(const std::string& output, int width, int height,
                                      double framesPerSecond)
{
    std::ostringstream rate;
    rate.precision(10);
    rate << framesPerSecond;
    return {"ffmpeg",    "-loglevel",
            "error",     "-y",
            "-f",        "rawvideo",
            "-pix_fmt",  "rgb24",
            "-s",        std::to_string(width) + "x" + std::to_string(height),
            "-r",        rate.str(),
            "-i",        "-",
            "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
            "-pix_fmt",  "yuv420p",
            "-movflags", "+faststart",
            output};
}

/// Starts `program` in a process group of its own, so that Ctrl-C reaches only us, with `input` as standard
/// input.
int spawn(const std::string& program, std::vector<std::string> arguments, int input, pid_t& outProcess)
{
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    const int error =
        posix_spawn(&outProcess, program.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

} // namespace

std::filesystem::path findFfmpeg()
{
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path candidate = std::filesystem::path(folder) / "ffmpeg";
        if (access(candidate.c_str(), X_OK) == 0)
            return candidate;
    }
    return {};
}

FfmpegPipe::~FfmpegPipe()
{
    if (input_ >= 0)
        close(input_);
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

base::Status FfmpegPipe::start(const std::filesystem::path& target, int width, int height,
                               double framesPerSecond)
{
    const std::filesystem::path program = findFfmpeg();
    if (program.empty())
        return {base::Code::NotFound,
                "MP4 needs the ffmpeg program, which is not installed (apt-get install ffmpeg); "
                "or write a sequence: -o name.%04d.png"};
    int ends[2];
    // A socket, since writing to the pipe of a program that has ended kills games that do not ignore SIGPIPE.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return ioError("cannot connect to ffmpeg");
    target_ = target;
    temporary_ = temporaryNameFor(target);
    enteredFile_ = EndsWithProgram(temporary_.string());
    const int error =
        spawn(program.string(), argumentsFor("file:" + temporary_.string(), width, height, framesPerSecond),
              ends[0], process_);
    close(ends[0]);
    input_ = ends[1];
    if (error == 0) {
        enteredProcess_ = EndsWithProgram(process_);
        return {};
    }
    process_ = -1;
    errno = error;
    return ioError("cannot start " + program.string());
}

base::Status FfmpegPipe::write(std::span<const uint8_t> rgb)
{
    while (!rgb.empty()) {
        const ssize_t written = send(input_, rgb.data(), rgb.size(), MSG_NOSIGNAL);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return ioError("ffmpeg stopped reading frames for " + target_.string());
        rgb = rgb.subspan(size_t(written));
    }
    return {};
}

base::Status FfmpegPipe::wait()
{
    int state = 0;
    while (waitpid(process_, &state, 0) < 0) {
        if (errno != EINTR)
            return ioError("cannot wait for ffmpeg");
    }
    process_ = -1;
    enteredProcess_ = {};
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return {};
    return {base::Code::Io, "ffmpeg could not write " + target_.string()};
}

base::Status FfmpegPipe::finish()
{
    close(std::exchange(input_, -1));
    if (base::Status status = wait(); !status)
        return status;
    if (rename(temporary_.c_str(), target_.c_str()) != 0)
        return ioError("cannot create " + target_.string());
    temporary_.clear();
    enteredFile_ = {};
    return {};
}

} // namespace fx::cli
