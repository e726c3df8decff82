#pragma once
// What VoxelCore asks of libcrypto, SHA-256, by Debian's libmd: a few kB of WebAssembly instead of some MB.

#include <cstddef>
#include <cstdint>
#include <memory>

#include <sha2.h>

struct evp_md_ctx_st : SHA2_CTX
{};
using EVP_MD_CTX = evp_md_ctx_st;

inline EVP_MD_CTX *
EVP_MD_CTX_new()
{
  return std::make_unique<EVP_MD_CTX>().release();
}

inline void
EVP_MD_CTX_free(EVP_MD_CTX * context)
{
  const std::unique_ptr<EVP_MD_CTX> owned(context);
}

inline const void *
EVP_sha256()
{
  return nullptr;
}

inline int
EVP_DigestInit_ex(EVP_MD_CTX * context, const void *, std::nullptr_t)
{
  SHA256Init(context);
  return 1;
}

inline int
EVP_DigestUpdate(EVP_MD_CTX * context, const void * bytes, std::size_t size)
{
  SHA256Update(context, static_cast<const std::uint8_t *>(bytes), size);
  return 1;
}

inline int
EVP_DigestFinal_ex(EVP_MD_CTX * context, unsigned char * digest, std::nullptr_t)
{
  SHA256Final(digest, context);
  return 1;
}
