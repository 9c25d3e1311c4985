// Shows how far a computation is, and cancels another one by an exception.
//
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>

#include <ptlib/ptlib.hpp>

int main()
try {
    const ptlib::engine engine;
    ptlib::graph graph = engine.new_graph();
    const ptl_block noise = graph.add("perlin noise");
    const ptl_block end = graph.add("end");
    graph.connect(noise, end);

    ptlib::compute_options options;
    options.width = options.height = 2048;
    options.interval = std::chrono::milliseconds(100);
    options.progress = [](const ptl_progress &progress) {
        std::cout << "here: " << static_cast<int>(progress.fraction * 100) << " %\n";
        return true;
    };
    graph.compute(end, options);

    // On a thread of its own; the callback runs inside wait(), which throws what it throws.
    options.width = options.height = 4096;
    options.progress = [](const ptl_progress &progress) -> bool {
        if (progress.fraction >= 0.3) {
            throw std::runtime_error("that is enough");
        }
        return true;
    };
    ptlib::job job = graph.start(end, options);
    try {
        job.wait();
    } catch (const std::runtime_error &enough) {
        std::cout << "job: " << enough.what() << '\n';
        return EXIT_SUCCESS;
    }
    return EXIT_FAILURE;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
