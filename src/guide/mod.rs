//! Long documents: what bryla computes, how well, and how a scene is written down.
//!
//! | document | answers |
//! |---|---|
//! | [`lecture`] | Which equation is lecture (27), and where is it in the code? |
//! | [`accuracy`] | What does a method keep and lose, how is its error known, what does a digit cost? |
//! | [`hard_cases`] | Which motions break methods, what is true of them, and is that tested? |
//! | [`scenes`] | What may stand in a scene file, in which unit, and what if it is left out? |

pub mod accuracy;
pub mod hard_cases;
pub mod lecture;
#[cfg(feature = "serde")]
pub mod scenes;
