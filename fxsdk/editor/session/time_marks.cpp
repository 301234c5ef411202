#include "fxsdk/editor/session/time_marks.h"

#include "fxsdk/editor/document/solo_mute.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace fx::editor {

namespace {

constexpr double kHundredths = 100.0;
constexpr double kSlack = 1e-6; // [1/100 s] by which sums of rounded times differ from rounded times

/// Calls `use` with the object elements of an array member and their pointers.
template <class Use>
void forEachIn(const Json& object, const char* member, const std::string& pointer, Use&& use)
{
    const auto list = object.find(member);
    if (list == object.end() || !list->is_array())
        return;
    for (size_t i = 0; i < list->size(); ++i)
        if ((*list)[i].is_object())
            use((*list)[i], pointer + "/" + member + "/" + std::to_string(i));
}

/// Adds the mark of a number; absent numbers have none.
void add(const Json& object, const char* member, const std::string& pointer, MarkKind kind, double begin,
         std::vector<TimeMark>& io)
{
    const auto found = object.find(member);
    if (found != object.end() && found->is_number())
        io.push_back({pointer + "/" + member, kind, begin + found->get<double>(), begin});
}

/// Local time [s] of the first birth that needs no event of another emitter; empty: there is none.
std::optional<double> firstBirth(const Json& emission)
{
    const auto numberOf = [](const Json& object, const char* name) {
        const auto found = object.find(name);
        return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
    };
    std::optional<double> first;
    if (numberOf(emission, "rate") > 0.0)
        first = numberOf(emission, "start");
    forEachIn(emission, "bursts", "", [&](const Json& burst, const std::string&) {
        const double time = numberOf(burst, "time");
        first = std::min(first.value_or(time), time);
    });
    return first;
}

void addElement(const Json& element, const std::string& pointer, std::vector<TimeMark>& io)
{
    add(element, "start", pointer, MarkKind::Start, 0.0, io);
    const auto emission = element.find("emission");
    if (emission == element.end() || !emission->is_object())
        return;
    const std::string at = pointer + "/emission";
    add(*emission, "start", at, MarkKind::Start, 0.0, io);
    forEachIn(*emission, "bursts", at, [&](const Json& burst, const std::string& where) {
        add(burst, "time", where, MarkKind::Burst, 0.0, io);
    });
    if (const std::optional<double> first = firstBirth(*emission))
        forEachIn(element, "events", pointer, [&](const Json& event, const std::string& where) {
            add(event, "age", where, MarkKind::Event, *first, io);
        });
}

double timeOf(const Json& element, double otherwise)
{
    const auto found = element.is_object() ? element.find("time") : element.end();
    return element.is_object() && found != element.end() && found->is_number() ? found->get<double>()
                                                                               : otherwise;
}

/// Marks of a list in order of time. @param gap [s] smallest distance of two of them
void addOrdered(const Json& holder, const char* member, const std::string& pointer, MarkKind kind,
                double first, double gap, std::vector<TimeMark>& io)
{
    forEachIn(holder, member, pointer, [&](const Json& element, const std::string& where) {
        if (!element.contains("time") || !element["time"].is_number())
            return;
        const Json& list = holder[member];
        const size_t index = std::stoul(where.substr(where.rfind('/') + 1));
        TimeMark mark{where + "/time", kind, timeOf(element, 0.0)};
        mark.least = index > 0 ? std::max(timeOf(list[index - 1], first) + gap, first) : first;
        if (index + 1 < list.size())
            mark.most = timeOf(list[index + 1], mark.most) - gap;
        io.push_back(std::move(mark));
    });
}

void addTriggers(const Json& instance, const std::string& where, std::vector<TimeMark>& io)
{
    const Json& start = instance.value("start", Json(0.0));
    addOrdered(instance, "triggers", where, MarkKind::Trigger, start.is_number() ? start.get<double>() : 0.0,
               0.0, io);
}

void addCameraKeys(const Json& holder, const std::string& where, std::vector<TimeMark>& io)
{
    const auto camera = holder.find("camera");
    if (camera != holder.end() && camera->is_object())
        addOrdered(*camera, "keys", where + "/camera", MarkKind::CameraKey, 0.0, 1.0 / kHundredths, io);
}

void addPreview(const Json& preset, std::vector<TimeMark>& io)
{
    const auto preview = preset.find("preview");
    if (preview == preset.end() || !preview->is_object())
        return;
    const auto instance = preview->find("instance");
    if (instance != preview->end() && instance->is_object())
        addTriggers(*instance, "/preview/instance", io);
    addCameraKeys(*preview, "/preview", io);
}

} // namespace

std::vector<TimeMark> timeMarks(const Document& document)
{
    std::vector<TimeMark> marks;
    if (!document.json().is_object())
        return marks;
    if (document.kind() == DocumentKind::Scene) {
        forEachIn(document.json(), "instances", "", [&](const Json& instance, const std::string& where) {
            add(instance, "start", where, MarkKind::Start, 0.0, marks);
            addTriggers(instance, where, marks);
        });
        addCameraKeys(document.json(), "", marks);
        return marks;
    }
    for (const std::string& pointer : soloElements(document.json(), document.schema()))
        if (const Json& element = document.json().at(Json::json_pointer(pointer)); element.is_object())
            addElement(element, pointer, marks);
    // The timeline begins after the prewarm.
    const Json& prewarm = document.json().value("prewarm", Json(0.0));
    const double before = prewarm.is_number() ? prewarm.get<double>() : 0.0;
    for (TimeMark& mark : marks) {
        mark.time -= before;
        mark.begin -= before;
    }
    addPreview(document.json(), marks); // what the host does counts from the beginning of the picture
    return marks;
}

std::string markText(const Document& document, const TimeMark& mark)
{
    const Json& element = document.json().at(Json::json_pointer(mark.pointer).parent_pointer());
    const auto text = [&]() -> std::string {
        switch (mark.kind) {
        case MarkKind::Start:
            return "start";
        case MarkKind::Burst:
            return "burst";
        case MarkKind::Event:
            return "event at an age";
        case MarkKind::Trigger:
            return "trigger " + element.value("name", Json("?")).dump();
        case MarkKind::CameraKey:
            return "camera key";
        }
        return {};
    };
    char at[32];
    std::snprintf(at, sizeof at, " at %.2f s", mark.time);
    return text() + at;
}

Json timeAt(const Document& document, const TimeMark& mark, double time)
{
    const double least = std::ceil(mark.least * kHundredths - kSlack);
    const double most = std::floor(mark.most * kHundredths + kSlack);
    if (least > most) // no rounded time is between the neighbors
        return document.json().at(Json::json_pointer(mark.pointer));
    const double value = std::clamp(std::round((time - mark.begin) * kHundredths), least, most) / kHundredths;
    const Json* const schema = schemaAt(document.schema(), document.json(), Json::json_pointer(mark.pointer));
    const auto limit = [&](const char* name, double otherwise) {
        return schema && schema->contains(name) ? (*schema)[name].get<double>() : otherwise;
    };
    return std::clamp(value, limit("minimum", 0.0), limit("maximum", 1e9));
}

} // namespace fx::editor
