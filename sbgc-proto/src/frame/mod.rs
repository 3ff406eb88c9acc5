//! Framing of both protocol versions: bytes to frames and back. Knows no message.
