// Long work: other Python threads go on, Ctrl-C stops it, a callback hears of it.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <morsel/progress.hpp>
#include <optional>

namespace morsel::python {

namespace py = pybind11;

/// Runs work(progress) on a thread of its own without the GIL. Meanwhile the calling thread passes
/// reports on to `callback`, callable with (stage, fraction) or None, and looks for signals: when
/// the callback or a signal's handler raises, as Ctrl-C does, the work is cancelled and that
/// exception is thrown. Throws what the work throws. Call with the GIL held.
void run_cancellable(const py::object& callback,
                     const std::function<void(const Progress& progress)>& work);

/// The same for work that has a result.
template <class Work>
auto long_work(const py::object& callback, const Work& work) {
  std::optional<decltype(work(std::declval<const Progress&>()))> result;
  run_cancellable(callback, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

/// Short work: without the GIL, not to be interrupted.
template <class Work>
auto short_work(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

}  // namespace morsel::python
