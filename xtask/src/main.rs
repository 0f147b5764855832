//! Building, serving and testing: everything that is not the product.
fn main() {}
