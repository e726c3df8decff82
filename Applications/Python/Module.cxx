// The Python module voxelcore._voxelcore. What users see is voxelcore/__init__.py.

#include "ModuleParts.h"
#include "OwnThread.h"
#include "Pickling.h"
#include "PythonWords.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Options/Command.h"

#include <pybind11/stl.h>

#include <array>
#include <exception>
#include <string>
#include <utility>

namespace py = pybind11;
using namespace voxelcore; // NOLINT: the module speaks its library's language

namespace
{

const char *
KindName(ParameterKind kind)
{
  switch (kind)
  {
    case ParameterKind::Integer:
      return "int";
    case ParameterKind::Real:
      return "float";
    case ParameterKind::Choice:
      return "choice";
    case ParameterKind::Flag:
      return "bool";
    case ParameterKind::Input:
    case ParameterKind::Inputs:
    case ParameterKind::Output:
      return "path";
    case ParameterKind::Text:
      break;
  }
  return "str";
}

/** What each command's options are to Python: a dict an option. */
py::list
OptionTable()
{
  py::list table;
  for (const Command & command : Commands())
  {
    for (const Parameter & parameter : command.rows)
    {
      py::dict row;
      row["command"] = std::string(command.name);
      row["group"] = std::string(GroupHeading(parameter.group));
      row["name"] = std::string(parameter.name);
      row["flags"] = std::string(parameter.flags);
      row["keyword"] = KeywordOf(parameter);
      row["is_flag"] = parameter.kind == ParameterKind::Flag;
      row["kind"] = KindName(parameter.kind);
      row["placeholder"] = std::string(parameter.placeholder);
      row["default"] = std::string(parameter.defaultValue);
      row["description"] = std::string(parameter.description);
      table.append(row);
    }
  }
  return table;
}

/** A message with Python's words in it. File names that are no UTF-8 come through as Python has them. */
void
Raise(PyObject * type, const Error & error)
{
  const std::string text = InPythonWords(error.what());
  const auto        message = py::reinterpret_steal<py::object>(
    PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<Py_ssize_t>(text.size())));
  PyErr_SetObject(type, message.ptr());
}

void
TranslateErrors(const py::module_ & module)
{
  static PyObject * certificateError = nullptr;
  certificateError = PyErr_NewException("voxelcore.CertificateError", PyExc_RuntimeError, nullptr);
  module.attr("CertificateError") = py::reinterpret_borrow<py::object>(certificateError);
  py::register_exception_translator([](std::exception_ptr pointer) {
    try
    {
      std::rethrow_exception(std::move(pointer));
    }
    catch (const CertificateError & error)
    {
      Raise(certificateError, error);
    }
    catch (const UsageError & error)
    {
      Raise(PyExc_ValueError, error);
    }
    catch (const InputError & error)
    {
      Raise(PyExc_ValueError, error);
    }
    catch (const OutputError & error)
    {
      Raise(PyExc_OSError, error);
    }
  });
}

void
Define(py::module_ & module)
{
  TranslateErrors(module);
  module.attr("__version__") = VoxelCoreVersion();
  module.attr("version_text") = VersionText();
  DefineResults(module);
  DefineCalls(module);
  module.def("core_from_state", &CoreFromState);
  module.def("skeleton_from_state", &SkeletonFromState);
  module.def("skeleton_columns", [](const std::string & unit) {
    const auto named = UnitNamed(unit);
    if (!named)
    {
      throw UsageError("unit " + unit + ": expected 'mm' or 'voxel'");
    }
    return SkeletonColumnsJson(*named);
  });
  module.def("voxel_size", [](const std::string & text) {
    const auto size = ParseVoxelSize(text);
    if (!size)
    {
      throw UsageError("spacing " + Printable(text) +
                       ": expected one or three numbers above 0, in mm or with a unit, such as (0.5, 0.5, 2) or "
                       "'50um'");
    }
    return *size;
  });
  module.def("end_all", &EndAll);
  module.def("forget_left_behind", &ForgetLeftBehind);
  module.def("in_python_words", &InPythonWords);
  module.def("option_table", &OptionTable);
}

// pybind11 keeps what it knows for one interpreter, and takes the lock of the main one for it: in another it would wait
// for ever. So each interpreter asks (PEP 489), and all but the main one are refused.
PyObject *
CreateModule(PyObject * /*spec*/, PyModuleDef * /*definition*/)
{
  static PyObject * made = nullptr;
  if (PyInterpreterState_Get() != PyInterpreterState_Main())
  {
    PyErr_SetString(PyExc_ImportError,
                    "voxelcore works in the main interpreter only, not in a sub-interpreter; use a process of its own "
                    "(multiprocessing, concurrent.futures.ProcessPoolExecutor)");
    return nullptr;
  }
  try
  {
    if (made == nullptr) // else it was taken out of sys.modules: types cannot be made twice
    {
      static PyModuleDef definition;
      py::detail::get_internals();
      auto module = py::module_::create_extension_module("voxelcore._voxelcore", nullptr, &definition);
      Define(module);
      made = module.ptr();
    }
  }
  catch (py::error_already_set & error)
  {
    py::raise_from(error, PyExc_ImportError, "voxelcore cannot be initialized");
    return nullptr;
  }
  catch (const std::exception & error)
  {
    PyErr_SetString(PyExc_ImportError, error.what());
    return nullptr;
  }
  Py_INCREF(made);
  return made;
}

} // namespace

extern "C" PYBIND11_EXPORT PyObject *
PyInit__voxelcore()
{
  static std::array<PyModuleDef_Slot, 2> slots{ { { Py_mod_create, reinterpret_cast<void *>(&CreateModule) },
                                                  { 0, nullptr } } };
  static PyModuleDef                     definition{ PyModuleDef_HEAD_INIT, "_voxelcore", nullptr, 0,      nullptr,
                                 slots.data(),          nullptr,      nullptr, nullptr };
  return PyModuleDef_Init(&definition);
}
