#include "fxsdk/editor/program/headless_editor.h"

#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/program/editor_host.h"
#include "fxsdk/editor/program/input.h"
#include "rendering/platform/gl_context.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace fx::editor {

namespace {

constexpr uint64_t kScriptBytes = uint64_t(1) << 20;
constexpr double kFrameSeconds = 1.0 / 60.0;
constexpr std::chrono::seconds kGameTime{60}; ///< that a game has for an answer

class Runner
{
public:
    Runner(EditorHost& host, const HeadlessOptions& options) : host_(host), options_(options)
    {
        render::GlFunctions& gl = host_.preview().device().gl;
        gl.CreateTextures(GL_TEXTURE_2D, 1, &texture_);
        gl.TextureStorage2D(texture_, 1, GL_RGBA8, options.width, options.height);
        gl.CreateFramebuffers(1, &framebuffer_);
        gl.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    }
    ~Runner()
    {
        render::GlFunctions& gl = host_.preview().device().gl;
        gl.DeleteFramebuffers(1, &framebuffer_);
        gl.DeleteTextures(1, &texture_);
    }
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    base::Status frames(int count)
    {
        for (int i = 0; i < count; ++i) {
            if (cli::interruptRequested())
                return cli::interruptedStatus();
            ImGui::GetIO().DisplaySize = {float(options_.width), float(options_.height)};
            ImGui::GetIO().DeltaTime = float(kFrameSeconds);
            applyInput(queue_.take());
            if (base::Status status = host_.frame(kFrameSeconds, framebuffer_); !status)
                return status;
        }
        return {};
    }

    base::Status shot(const std::string& file)
    {
        return writePng(host_.preview().device(), texture_, options_.width, options_.height, file);
    }

    base::Status command(const std::string& line)
    {
        std::istringstream words(line);
        std::string verb;
        words >> verb;
        if (verb.empty() || verb[0] == '#')
            return {};
        if (verb == "frames") {
            int count = 1;
            words >> count;
            return frames(std::clamp(count, 0, 100000));
        }
        if (verb == "click" || verb == "doubleclick" || verb == "rightclick" || verb == "drag" ||
            verb == "at")
            return onWidget(verb, words);
        if (verb == "open")
            return open(words);
        if (verb == "shot" || verb == "text")
            return write(verb, words);
        if (verb == "places")
            return listPlaces();
        if (verb == "linked")
            return waitForGame();
        if (verb == "compared")
            return waitForReference();
        if (verb == "measured")
            return waitForBudget();
        if (verb == "rendered")
            return waitForPictures();
        return input(verb, words, line);
    }

    base::Status measure(int edits);

private:
    base::Status click(ImVec2 at, int button, int times)
    {
        moveMouse(at.x, at.y);
        base::Status status = frames(1);
        for (int i = 0; i < times && status.ok(); ++i) {
            pressMouse(button, true);
            status = frames(1);
            pressMouse(button, false);
            if (status.ok())
                status = frames(1);
        }
        return status.ok() ? frames(1) : status;
    }

    base::Status drag(ImVec2 from, ImVec2 way)
    {
        moveMouse(from.x, from.y);
        base::Status status = frames(1);
        pressMouse(0, true);
        for (int i = 0; i <= 8 && status.ok(); ++i) {
            moveMouse(from.x + way.x * float(i) / 8.0f, from.y + way.y * float(i) / 8.0f);
            status = frames(1);
        }
        pressMouse(0, false);
        return status.ok() ? frames(2) : status;
    }

    /// Finds a widget, and scrolls its panel if the middle of the widget is not seen.
    base::Status bringIntoView(const std::string& name, Place& outPlace)
    {
        PanelState& state = host_.state();
        const auto unknown = [&](const char* why, const std::string& remedy) {
            return base::Status(base::Code::NotFound, why + (" \"" + name + "\"; ") + remedy);
        };
        if (!state.places.contains(name))
            return unknown("no widget has the name", placeOf(name));
        if (!state.places[name].isVisible) {
            state.scrolledTo = name;
            const base::Status status = frames(3);
            state.scrolledTo.clear();
            if (!status)
                return status;
        }
        outPlace = state.places[name];
        return outPlace.isVisible
                   ? base::Status()
                   : unknown("the window is too small to show the widget", "--height makes it larger");
    }

    /// Where a widget lies that is not shown: in a closed header, or in another element.
    std::string placeOf(const std::string& name)
    {
        const PanelState& state = host_.state();
        const size_t slash = std::min(name.find('/'), name.size());
        const std::string pointer = name.substr(slash);
        for (const std::string& header : state.closedHeaders)
            if (pointer.starts_with(header + "/") || (slash > 0 && pointer == header))
                return "it may lie in the closed header " + header + ": open " + header;
        const Session& session = host_.session();
        for (const std::string& element : soloElements(session.document.json(), session.document.schema()))
            if ((pointer + "/").starts_with(element + "/") && session.selection != element)
                return "it may belong to " + element + ": click select" + element;
        return "the command places lists names";
    }

    /// Opens the headers in which a widget lies, and the widget where it is one; what is open stays so.
    base::Status open(std::istringstream& words)
    {
        PanelState& state = host_.state();
        std::getline(words >> std::ws, state.opened);
        const std::string name = state.opened;
        base::Status status = frames(1);
        state.opened.clear();
        Place ignored;
        return status.ok() ? bringIntoView(name, ignored) : status;
    }

    /// Names may have blanks: those of tabs, buttons and choices.
    base::Status onWidget(const std::string& verb, std::istringstream& words)
    {
        std::string name;
        std::getline(words >> std::ws, name);
        float x = 0.5f;
        float y = 0.5f;
        if (verb == "drag" || verb == "at") {
            const size_t second = name.find_last_of(' ');
            const size_t first = second == std::string::npos ? second : name.find_last_of(' ', second - 1);
            if (first == std::string::npos || std::sscanf(name.c_str() + first, "%f %f", &x, &y) != 2)
                return {base::Code::InvalidArgument, verb + " needs a name and two numbers"};
            name.resize(first);
        }
        Place place;
        if (base::Status status = bringIntoView(name, place); !status)
            return status;
        if (verb == "drag")
            return drag(place.middle(), {x, y});
        if (verb == "at")
            return click({place.low.x + x * (place.high.x - place.low.x),
                          place.low.y + y * (place.high.y - place.low.y)},
                         0, 1);
        return click(place.middle(), verb == "rightclick" ? 1 : 0, verb == "doubleclick" ? 2 : 1);
    }

    base::Status write(const std::string& verb, std::istringstream& words)
    {
        std::string file;
        std::getline(words >> std::ws, file);
        return verb == "shot" ? shot(file) : cli::writeFileAtomically(file, host_.session().document.text());
    }

    base::Status listPlaces()
    {
        for (const auto& [name, place] : host_.state().places)
            std::printf("%s %.0f %.0f %.0f %.0f\n", name.c_str(), double(place.low.x), double(place.low.y),
                        double(place.high.x), double(place.high.y));
        return {};
    }

    base::Status waitForGame()
    {
        const auto end = std::chrono::steady_clock::now() + kGameTime;
        const auto hasAnswered = [this] {
            return host_.state().link.edit.outcome().revision == host_.session().document.revision();
        };
        while (!hasAnswered()) {
            if (base::Status status = frames(1); !status)
                return status;
            if (std::chrono::steady_clock::now() > end)
                return {base::Code::Interrupted, "the game has not answered: " + linkText(host_.state())};
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        std::printf("%s\n", linkText(host_.state()).c_str());
        return {};
    }

    base::Status waitForReference()
    {
        const ErrorState& error = host_.state().error;
        base::Status status = frames(1);
        while (status.ok() && error.isRunning) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            status = frames(1);
        }
        if (status.ok())
            std::printf("%s\n", error.text.c_str());
        return status.ok() ? frames(2) : status;
    }

    base::Status waitForBudget()
    {
        base::Status status = frames(1);
        while (status.ok() && host_.state().budget.isRunning)
            status = frames(1);
        if (!status.ok())
            return status;
        const BudgetState& budget = host_.state().budget;
        if (!budget.failure.empty())
            std::printf("%s\n", budget.failure.c_str());
        for (const QualityCost& of : budget.report.qualities)
            std::printf(
                "quality %s: %u particles, simulation %.3f, lights %.3f, stage %.3f, effects %.3f ms\n",
                of.name.c_str(), of.particles, of.times.simulation, of.times.lights, of.times.stage,
                of.times.effects);
        const auto costOf = [](const PartCost& of) {
            std::printf("simulation %.3f, lights %.3f, effects %.3f, noise %.3f ms\n", of.times.simulation,
                        of.times.lights, of.times.effects, of.noise);
        };
        for (const PartCost& of : budget.report.techniques) {
            std::printf("technique %s: ", of.pointer.c_str());
            costOf(of);
        }
        for (const PartCost& of : budget.report.elements) {
            std::printf("%s: %u particles, ", of.pointer.c_str(), host_.state().picture.elements[of.pointer]);
            costOf(of);
        }
        for (const MomentCost& of : budget.report.moments)
            std::printf("at %.2f s: %u particles, simulation %.3f ms\n", of.time, of.particles,
                        of.simulation);
        std::printf("%s\n", budget.isOld ? "before the last change" : "of the present document");
        return frames(2);
    }

    base::Status waitForPictures()
    {
        base::Status status = frames(1);
        while (status.ok() && host_.state().render.isRunning)
            status = frames(1);
        std::printf("%s\n", host_.session().message.c_str());
        return status;
    }

    base::Status input(const std::string& verb, std::istringstream& words, const std::string& line)
    {
        float x = 0.0f;
        float y = 0.0f;
        if (verb == "type") {
            typeText(line.size() > 5 ? line.substr(line.find("type") + 5) : std::string());
            return frames(2);
        }
        if (verb == "key") {
            std::string key;
            words >> key;
            if (!pressKey(key, true))
                return {base::Code::InvalidArgument, "the key \"" + key + "\" is unknown"};
            const base::Status status = frames(1);
            (void)pressKey(key, false);
            return status.ok() ? frames(2) : status;
        }
        if (verb == "strike")
            return strike(words);
        words >> x;
        if (verb == "time")
            host_.session().playback.scrub(double(x));
        else if (verb == "wheel")
            turnWheel(x);
        else if (verb == "move" && words >> y)
            moveMouse(x, y);
        else if ((verb == "press" || verb == "release") && x >= 0.0f && x <= 2.0f)
            pressMouse(int(x), verb == "press");
        else
            return {base::Code::InvalidArgument, "\"" + line + "\" is no command; see docs/howto/editor.md"};
        return frames(1);
    }

    /// Keys that are pressed and released before the next frame.
    base::Status strike(std::istringstream& words)
    {
        for (std::string key; words >> key;)
            if (!strikeKey(key, queue_))
                return {base::Code::InvalidArgument, "the key \"" + key + "\" is unknown"};
        base::Status status = frames(1);
        while (status.ok() && queue_.size() > 0)
            status = frames(1);
        return status.ok() ? frames(1) : status;
    }

    EditorHost& host_;
    const HeadlessOptions& options_;
    InputQueue queue_;
    uint32_t texture_ = 0;
    uint32_t framebuffer_ = 0;
};

/// Memory that the process holds [MiB]; 0 where the system does not tell.
double residentMiB()
{
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * double(sysconf(_SC_PAGESIZE)) / double(1 << 20);
}

/// Changes a number again and again, and takes the time until a frame shows it, and the memory that it costs.
/// The first tenth of the edits fills what is kept.
base::Status Runner::measure(int edits)
{
    Session& session = host_.session();
    const auto elements = soloElements(session.document.json(), session.document.schema());
    const std::string pointer = elements.empty() ? "/wind" : elements.front() + "/position";
    std::vector<double> milliseconds;
    int mostFrames = 0;
    uint32_t compiled = 0;
    double resident = residentMiB();
    for (int i = 0; i < edits; ++i) {
        if (i == edits / 10)
            resident = residentMiB();
        const auto start = std::chrono::steady_clock::now();
        if (base::Status status = session.document.set(pointer, Json::array({0.01 * (i % 7), 0.5, 0}));
            !status)
            return status;
        int count = 0;
        while (count == 0 || host_.pictureRevision() != session.shownRevision()) {
            if (base::Status status = frames(1); !status)
                return status;
            ++count;
        }
        host_.preview().device().gl.Finish();
        milliseconds.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        mostFrames = std::max(mostFrames, count);
        compiled += host_.preview().statistics().programsCompiled;
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    std::printf("%d edits of %s: median %.1f ms, p95 %.1f ms from the edit to the picture; at most %d "
                "frames; %u late compiles; memory grew by %.1f MiB\n",
                edits, pointer.c_str(), milliseconds[milliseconds.size() / 2],
                milliseconds[milliseconds.size() * 95 / 100], mostFrames, compiled, residentMiB() - resident);
    return {};
}

base::Status runScript(Runner& runner, const std::string& file)
{
    const auto script = asset::readFile(file, kScriptBytes);
    if (!script)
        return script.status();
    std::istringstream lines(*script);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        if (base::Status status = runner.command(line); !status)
            return {status.code(), file + ":" + std::to_string(number) + ": " + status.message()};
    return {};
}

} // namespace

base::Status runHeadless(std::unique_ptr<Session> session, const HeadlessOptions& options)
{
    auto context = render::createEglContext({});
    if (!context)
        return context.status();
    const ImGuiOwner imgui;
    applyStyle(options.scale);
    startInput();
    auto host = EditorHost::create(std::move(session), (*context)->loader());
    if (!host)
        return host.status();
    Runner runner(**host, options);
    base::Status status = options.isLinked ? (*host)->link(options.link) : base::Status();
    if (status.ok())
        status = runner.frames(3);
    if (status.ok() && !options.script.empty())
        status = runScript(runner, options.script);
    if (status.ok() && options.measuredEdits > 0)
        status = runner.measure(options.measuredEdits);
    if (status.ok() && !options.output.empty())
        status = runner.shot(options.output);
    Session& edited = (*host)->session();
    const std::string kept = status.ok() ? std::string() : edited.keepForRecovery();
    if (kept.empty()) {
        const bool isOther = !status.ok() && edited.document.isDirty() && edited.recovery();
        edited.close();
        return isOther ? base::Status(status.code(),
                                      status.message() +
                                          "; the edits that were not saved are lost, since those "
                                          "of an earlier session wait for an answer (click recover, "
                                          "or click discard)")
                       : status;
    }
    return {status.code(),
            status.message() + "; the edits that were not saved are kept in " + kept +
                "; fx edit with the same file and options offers them (in a script: click recover)"};
}

} // namespace fx::editor
