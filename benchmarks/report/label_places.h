/// @file label_places.h
/// Where the names of points go in a plot so that they can be read.
#pragma once

#include <string>
#include <vector>

namespace fx::cli {

/// Places labels beside their points, one after the other, where they cover the least of earlier drawings.
class LabelPlaces
{
public:
    struct Place
    {
        double x, y; ///< [pixel] of the text's start on its base line
    };

    /// Labels stay within this rectangle.
    LabelPlaces(double left, double top, double right, double bottom);

    /// A point that labels should not cover.
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
