/// @file label_places.h
/// Places the names of points in a plot so that the names are readable.
#pragma once

#include <string>
#include <vector>

namespace fx::cli {

/// Places labels beside their points, one after another. A label covers as little as possible of the labels
/// placed before.
class LabelPlaces
{
public:
    struct Place
    {
        double x, y; ///< [pixel] start of the text on its base line
    };

    /// Labels stay within this rectangle.
    LabelPlaces(double left, double top, double right, double bottom);

    /// Adds a point that labels should not cover.
    void avoid(double x, double y);
    Place place(double x, double y, const std::string& label);

private:
    struct Box
    {
        double left, top, right, bottom;
    };
    double cost(const Box& box) const;

    Box frame_;
    std::vector<Box> taken_;
};

} // namespace fx::cli
