#include "benchmarks/measure/callgrind.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace fx::cli {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed with everything in it.
class ScratchFolder
{
public:
    ScratchFolder()
    {
        std::error_code ignored;
        std::string name = (fs::temp_directory_path(ignored) / "fx-accuracy-XXXXXX").string();
        if (mkdtemp(name.data()))
            path_ = name;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        if (!path_.empty())
            fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Runs a program of PATH without output. @return its exit code, -1 when it could not be started or was
/// killed
int runSilently(std::vector<std::string> words)
{
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int state = 0;
    if (error != 0 || waitpid(child, &state, 0) != child || !WIFEXITED(state))
        return -1;
    return WEXITSTATUS(state);
}

/// callgrind writes out.1, out.2, ... at each dump and, at the end, out itself.
std::vector<double> readDumps(const fs::path& folder, size_t count)
{
    std::vector<double> totals;
    for (size_t k = 1; k <= count; ++k) {
        std::ifstream file(folder / ("out." + std::to_string(k)));
        std::stringstream text;
        text << file.rdbuf();
        const std::vector<double> parts = callgrindTotals(text.str());
        if (parts.size() == 1)
            totals.push_back(parts.front());
    }
    return totals;
}

} // namespace

bool hasCallgrind()
{
    static const bool kRuns = [] {
        std::error_code error;
        const fs::path self = fs::read_symlink("/proc/self/exe", error);
        return !error && runSilently({"valgrind", "--tool=none", self.string(), "--version"}) == 0;
    }();
    return kRuns;
}

std::vector<double> callgrindTotals(const std::string& text)
{
    std::vector<double> totals;
    std::istringstream lines(text);
    const std::string key = "totals:";
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(key, 0) == 0)
            totals.push_back(std::strtod(line.c_str() + key.size(), nullptr));
    return totals;
}

base::Result<std::vector<double>> countUnderCallgrind(const std::vector<std::string>& arguments,
                                                      const std::string& function, size_t calls)
{
    const ScratchFolder folder;
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    if (error || folder.path().empty())
        return base::Status(base::Code::Io,
                            "callgrind: no temporary folder, or the program does not find itself");
    const std::string file = (folder.path() / "out").string();
    std::vector<std::string> words{"valgrind",
                                   "--tool=callgrind",
                                   "--toggle-collect=" + function,
                                   "--dump-after=" + function,
                                   "--callgrind-out-file=" + file,
                                   self.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const int exitCode = runSilently(std::move(words));
    std::vector<double> totals = readDumps(folder.path(), calls);
    const bool isPlausible =
        std::all_of(totals.begin(), totals.end(), [](double count) { return count > 0; });
    if (exitCode != 0 || totals.size() != calls || !isPlausible)
        return base::Status(base::Code::Internal, "callgrind: gave " + std::to_string(totals.size()) +
                                                      " of " + std::to_string(calls) + " counts, exit code " +
                                                      std::to_string(exitCode));
    return totals;
}

base::Result<std::vector<double>> countUnderCallgrind(const std::string& technique, const std::string& scene,
                                                      size_t settings)
{
    return countUnderCallgrind({"accuracy", technique, "--scene", scene, "--count-work"}, "fxAccuracyWork",
                               settings);
}

} // namespace fx::cli
