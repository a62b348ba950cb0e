#include "files/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace manzana::files {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(errno == ENOENT ? "no such file" : std::string("cannot be read: ") + std::strerror(errno));
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const int handle = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) fail();
  struct stat status {};
  const bool regular = fstat(handle, &status) == 0 && S_ISREG(status.st_mode);
  size_ = regular ? static_cast<std::size_t>(status.st_size) : 0;
  if (size_ > 0) at_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, handle, 0);
  const int error = errno;
  close(handle);
  if (!regular) throw std::runtime_error("is no file");
  if (at_ == MAP_FAILED) errno = error, fail();
}

MappedFile::~MappedFile() {
  if (size_ > 0) munmap(at_, size_);
}

void MappedFile::let_go() const {
  if (size_ > 0) madvise(at_, size_, MADV_DONTNEED);
}

}  // namespace manzana::files
