//! The examples of the project's front page, which are tested as they stand there.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct FrontPage;
