// Builds a graph by hand, computes it, and saves the graph and its picture.
//
// Bump noise becomes the red of the picture, a Voronoi diagram the green, and that diagram sent
// through a circle transform the blue. Each is multiplied with its colour; the sum is the result.
//
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

#include <ptlib/ptlib.hpp>

static ptl_block add_mix(ptlib::graph &graph, const char *method, ptl_block first,
                         ptl_block second)
{
    const ptl_block mix = graph.add("mix");
    graph.set_text(mix, "method", method);
    graph.connect(first, mix, 0);
    graph.connect(second, mix, 1);
    return mix;
}

// A block that gives `source` in one colour.
static ptl_block add_tint(ptlib::graph &graph, ptl_block source, int red, int green, int blue)
{
    const ptl_block fill = graph.add("color fill");
    graph.set_int(fill, "red", red);
    graph.set_int(fill, "green", green);
    graph.set_int(fill, "blue", blue);
    return add_mix(graph, "multiply", source, fill);
}

static ptl_block build(ptlib::graph &graph)
{
    graph.set_size(256, 256);
    const ptl_block bumps = graph.add("bump noise");
    graph.set_float(bumps, "bump size from", 0.3);
    const ptl_block cells = graph.add("voronoi diagram");
    graph.set_int(cells, "number of points", 30);
    const ptl_block circles = graph.add("circle transform");
    graph.connect(cells, circles);

    const ptl_block red = add_tint(graph, bumps, 255, 0, 0);
    const ptl_block green = add_tint(graph, cells, 0, 255, 0);
    const ptl_block blue = add_tint(graph, circles, 0, 0, 255);
    const ptl_block end = graph.add("end");
    graph.connect(add_mix(graph, "add", add_mix(graph, "add", red, green), blue), end);
    return end;
}

int main()
try {
    const ptlib::engine engine;
    ptlib::graph graph = engine.new_graph();
    const ptl_block end = build(graph);

    std::ofstream file("build_graph.xml", std::ios::binary);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file << graph.save();

    graph.compute(end).save("build_graph.png");
    std::cout << "build_graph.xml and build_graph.png\n";
    return EXIT_SUCCESS;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
