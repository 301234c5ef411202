#include "benchmarks/report/label_places.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr double kLetter = 6.3;  // [pixel] of 11 pixel sans-serif, a little more than the mean
constexpr double kHeight = 11.0; // [pixel]

} // namespace

LabelPlaces::LabelPlaces(double left, double top, double right, double bottom)
    : frame_{left, top, right, bottom}
{}

void LabelPlaces::avoid(double x, double y)
{
    taken_.push_back({x - 5, y - 5, x + 5, y + 5});
}

/// [pixel^2] covered, with what leaves the frame counted tenfold.
double LabelPlaces::cost(const Box& box) const
{
    const auto common = [&box](const Box& other) {
        const double width = std::min(box.right, other.right) - std::max(box.left, other.left);
        const double height = std::min(box.bottom, other.bottom) - std::max(box.top, other.top);
        return std::max(width, 0.0) * std::max(height, 0.0);
    };
    const double area = (box.right - box.left) * (box.bottom - box.top);
    double sum = 10.0 * (area - common(frame_));
    for (const Box& other : taken_)
        sum += common(other);
    return sum;
}

LabelPlaces::Place LabelPlaces::place(double x, double y, const std::string& label)
{
    const double width = kLetter * double(label.size());
    Box best = {};
    double least = -1;
    for (const double away : {0.0, 4.0, 8.0, 12.0, 20.0, 30.0})
        for (const double side : {1.0, -1.0, 0.0})
            for (const double up : {0.0, 1.0, -1.0}) {
                if (side == 0.0 && up == 0.0)
                    continue;
                const double middleX = x + side * (8 + 0.5 * width);
                const double middleY = y + up * (side == 0.0 ? 13 : 7) + up * away;
                const Box box = {middleX - 0.5 * width, middleY - 0.5 * kHeight, middleX + 0.5 * width,
                                 middleY + 0.5 * kHeight};
                const double price = cost(box) + 4.0 * away + 0.5 * std::abs(up) + (side == 1.0 ? 0.0 : 1.0);
                if (least < 0 || price < least) {
                    least = price;
                    best = box;
                }
            }
    taken_.push_back(best);
    return {best.left, best.bottom - 2};
}

} // namespace fx::cli
